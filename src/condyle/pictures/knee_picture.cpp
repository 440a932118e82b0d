#include "condyle/pictures/knee_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

#include "condyle/input_error.h"
#include "condyle/pictures/annotate.h"
#include "condyle/pictures/framing.h"
#include "condyle/pictures/gap_map.h"
#include "condyle/pictures/joint_axes.h"
#include "condyle/pictures/knee_shapes.h"
#include "condyle/pictures/pressure_map.h"
#include "condyle/pictures/renderer.h"
#include "condyle/pictures/seen_insertions.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kFramePoses = 40;                     // about as many decide the frame
constexpr double kPlainSpacing = 1.2, kColorSpacing = 0.7;  // between vertices of patches [mm]
constexpr double kOutline = 0.16;                           // radius of its line [mm]
constexpr double kKneeRadius = 25;                    // what is smaller has smaller marks [mm]
constexpr double kContactDot = 1.5, kSmallDot = 0.7;  // [mm]

void check_size(const PictureOptions& options) {
  if (!is_drawable(options))
    throw InputError(fmt::format("picture size {}x{}, expected {} to {} pixels each way",
                                 options.width, options.height, kLeastPicture, kGreatestPicture));
}

}  // namespace

bool is_drawable(const PictureOptions& options) {
  const auto good = [](int size) { return size >= kLeastPicture && size <= kGreatestPicture; };
  return good(options.width) && good(options.height);
}

struct KneePictures::State {
  struct KeptShape {
    int body;
    Item item;
  };

  const Run& run;
  PictureOptions options;
  PageLayout page;
  PictureScales scales;
  Renderer renderer;
  std::vector<BodyShape> body_meshes;
  std::vector<KeptShape> shapes;              // of body_meshes
  std::vector<std::vector<Vector3d>> joints;  // of each body, what must be in a picture
  std::optional<GapMap> gaps;
  std::optional<PressureMap> pressures;
  std::array<int, 2> outlines = {-1, -1};  // of the areas of pressure, on tibia and femur
  std::array<int, 2> path = {-1, -1}, reference_path = {-1, -1};  // on tibia and femur
  int ligaments = -1, contacts = -1, ellipses = -1, arrows = -1, crosses = -1, axes = -1;
  std::array<std::optional<Staging>, kViewCount> stagings;
  std::array<std::optional<Camera>, kViewCount> cameras;
  struct Seen {
    Eigen::Matrix3d R_VB;
    std::vector<bool> insertions;
  };
  std::array<std::optional<Seen>, kViewCount> seen;  // of the pose before: of most views it stays

  State(const Run& r, const PictureOptions& o);
  [[nodiscard]] std::array<int, 2> bodies() const {
    return {tibia_body(run.scene), femur_body(run.scene)};
  }
  [[nodiscard]] const Staging& staging(View view);
  [[nodiscard]] const Camera& camera(View view);
  [[nodiscard]] Scenery scenery(View view, const PoseResult& pose);
  void add_points_in_view(const PoseResult& pose,
                          const Staging& staging,
                          std::vector<Vector3d>& points) const;
  [[nodiscard]] Camera frame_all(View view);
  void fill_meshes(Scenery& scenery);
  [[nodiscard]] bool is_colored(std::size_t shape, const Scenery& scenery) const;
  [[nodiscard]] double paint_gaps(const Scenery& scenery);
  void paint_pressures(const Scenery& scenery);
  [[nodiscard]] std::vector<Item> items(Scenery& scenery);
};

KneePictures::State::State(const Run& r, const PictureOptions& o)
    : run(r),
      options(o),
      page(o.panel ? panel_layout(o.width, o.height) : page_layout(o.width, o.height)),
      renderer(o.width, o.height),
      body_meshes(
          body_shapes(r, o.colors == SurfaceColors::kPlain ? kPlainSpacing : kColorSpacing)) {
  for (const BodyShape& shape : body_meshes) {
    shapes.push_back(
        {shape.body, {renderer.add(shape.mesh), {}, shape.layer, shape.gloss, shape.closed}});
  }
  joints = joint_points(run, body_meshes);
  const double radius = joint_radius(joints);
  scales = picture_scales(run, radius > 0 ? std::min(1.0, radius / kKneeRadius) : 1);
  if (options.colors == SurfaceColors::kGap) gaps.emplace(run);
  if (options.colors == SurfaceColors::kPressure) pressures.emplace(run);
  for (std::size_t i = 0; i < 2; ++i) {
    path[i] = renderer.add(contact_paths(run, bodies()[i], scales));
    reference_path[i] = renderer.add(reference_paths(run, bodies()[i], scales));
    outlines[i] = renderer.add({});
  }
  for (int* id : {&ligaments, &contacts, &ellipses, &arrows, &crosses, &axes})
    *id = renderer.add({});
}

const Staging& KneePictures::State::staging(View view) {
  auto& staging = stagings[static_cast<std::size_t>(view)];
  if (!staging) staging = staging_of(run, view);
  return *staging;
}

const Camera& KneePictures::State::camera(View view) {
  auto& camera = cameras[static_cast<std::size_t>(view)];
  if (!camera) camera = frame_all(view);
  return *camera;
}

Scenery KneePictures::State::scenery(View view, const PoseResult& pose) {
  const Staging& stage = staging(view);
  Scenery scenery{run,
                  pose,
                  view,
                  camera(view),
                  scales,
                  stage,
                  options.colors,
                  options.hertz,
                  staged_poses(run.scene, stage, pose.X_BA),
                  staged_marks(run.scene, stage, pose)};
  if (!stage.alone()) return scenery;
  const int body = stage.tibia ? tibia_body(run.scene) : femur_body(run.scene);
  if (body < 0) return scenery;
  const Eigen::Matrix3d& R_PB = scenery.X_P[static_cast<std::size_t>(body)].R;
  const Eigen::Matrix3d R_VB = scenery.camera.R_VP * R_PB;
  std::optional<Seen>& kept = seen[static_cast<std::size_t>(view)];
  if (!kept || kept->R_VB != R_VB)
    kept = Seen{R_VB, seen_insertions(run.scene, body_meshes, body, R_VB)};
  scenery.seen = kept->insertions;
  return scenery;
}

/// What must be in the picture: the joint, and the arrows of its forces.
void KneePictures::State::add_points_in_view(const PoseResult& pose,
                                             const Staging& staging,
                                             std::vector<Vector3d>& points) const {
  const auto X_P = staged_poses(run.scene, staging, pose.X_BA);
  for (std::size_t body = 0; body < joints.size(); ++body) {
    if (!staging.shows(run.scene, static_cast<int>(body))) continue;
    for (const Vector3d& p : joints[body]) points.push_back(X_P[body] * p);
  }
  if (staging.alone() || staging.apart()) return;
  for (const ContactMark& mark : contact_marks(run.scene, pose))  // what pulls has no arrow
    points.push_back(mark.point +
                     std::max(0.0, mark.force) * scales.arrow_mm_per_n * mark.toward_femur);
}

Camera KneePictures::State::frame_all(View view) {
  std::vector<const PoseResult*> poses;
  for (const PoseResult& pose : run.sweep.poses) {
    if (has_place(pose)) poses.push_back(&pose);
    if (view == View::kPlateau && !poses.empty()) break;  // the tibia stands still
  }
  const std::size_t stride = 1 + poses.size() / kFramePoses;
  std::vector<Vector3d> points;
  const Staging& stage = staging(view);
  for (std::size_t i = 0; i + 1 < poses.size(); i += stride)
    add_points_in_view(*poses[i], stage, points);
  if (!poses.empty()) add_points_in_view(*poses.back(), stage, points);
  if (points.empty())
    throw InputError(
        "nothing to draw: the run has no pose with a place, or neither meshes nor ligaments");
  return fit_camera(view_rotation(view, anatomy_of(run.scene)), points, page.joint());
}

bool KneePictures::State::is_colored(std::size_t shape, const Scenery& scenery) const {
  return body_meshes[shape].surface >= 0 && scenery.staging.shows(run.scene, shapes[shape].body);
}

/// The deepest overlap [mm].
double KneePictures::State::paint_gaps(const Scenery& scenery) {
  double deepest = 0;
  const auto X_P = body_poses(run.scene, scenery.pose.X_BA);  // as they stand, not lifted
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!is_colored(i, scenery)) continue;
    const double overlap = gaps->paint(
        body_meshes[i].mesh, static_cast<std::size_t>(body_meshes[i].surface), X_P, kCartilage);
    deepest = std::max(deepest, overlap);
    renderer.replace(shapes[i].item.mesh, body_meshes[i].mesh);
  }
  return deepest;
}

void KneePictures::State::paint_pressures(const Scenery& scenery) {
  const auto X_P = body_poses(run.scene, scenery.pose.X_BA);
  std::array<ShadedMesh, 2> lines;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!is_colored(i, scenery)) continue;
    append(lines[shapes[i].body == bodies()[0] ? 0 : 1],
           pressures->paint(body_meshes[i].mesh, static_cast<std::size_t>(body_meshes[i].surface),
                            X_P, kCartilage, kOutline * scales.size));
    renderer.replace(shapes[i].item.mesh, body_meshes[i].mesh);
  }
  for (std::size_t i = 0; i < 2; ++i) renderer.replace(outlines[i], lines[i]);
}

void KneePictures::State::fill_meshes(Scenery& scenery) {
  const Staging& stage = scenery.staging;
  ShadedMesh lines;
  if (stage.alone()) {
    lines =
        insertions(run, scenery.pose, stage.tibia ? bodies()[0] : bodies()[1], scenery.X_P, scales);
  } else {
    lines = stage.apart() ? ligament_threads(run, scenery.pose, scenery.X_P, scales)
                          : ligament_tubes(run, scenery.pose, scenery.X_P, scales);
  }
  renderer.replace(ligaments, lines);
  const bool areas = options.hertz || options.colors == SurfaceColors::kPressure;
  ShadedMesh dots = contact_points(scenery.marks, scales.size * (areas ? kSmallDot : kContactDot));
  if (!stage.apart()) append(dots, contact_lines(run.scene, scenery.pose, scales));
  renderer.replace(contacts, dots);
  renderer.replace(ellipses, options.hertz ? hertz_ellipses(scenery.marks) : ShadedMesh{});
  renderer.replace(arrows,
                   shows_arrows(scenery) ? force_arrows(scenery.marks, scales) : ShadedMesh{});
  if (options.frames) renderer.replace(axes, joint_axes(run.scene, stage, scenery.X_P));
  renderer.replace(crosses, edge_crosses(scenery.marks, scenery.camera.R_VP, scales));
  if (gaps) scenery.overlap = paint_gaps(scenery);
  if (pressures) {
    paint_pressures(scenery);
    scenery.pressure_top = pressures->top();
  }
}

std::vector<Item> KneePictures::State::items(Scenery& scenery) {
  fill_meshes(scenery);
  std::vector<Item> items;
  for (const KeptShape& shape : shapes) {
    if (!scenery.staging.shows(run.scene, shape.body)) continue;
    items.push_back(shape.item);
    items.back().X_PM = scenery.X_P[static_cast<std::size_t>(shape.body)];
  }
  for (std::size_t i = 0; i < 2 && !gaps; ++i) {
    const bool shown =
        i == 0 ? scenery.staging.tibia : !scenery.staging.tibia || scenery.staging.apart();
    if (!shown || bodies()[i] < 0) continue;
    for (const int mesh : {path[i], reference_path[i], outlines[i]})
      items.push_back(
          {mesh, scenery.X_P[static_cast<std::size_t>(bodies()[i])], Layer::kSolid, 0.12, true});
  }
  items.push_back({ligaments, {}, Layer::kSolid, 0.12, true});
  items.push_back({ellipses, {}, Layer::kMark, 0, false});
  for (const int mesh : {contacts, arrows, crosses, axes})
    items.push_back({mesh, {}, Layer::kMark, 0.12, true});
  return items;
}

KneePictures::KneePictures(const Run& run, const PictureOptions& options) {
  check_size(options);
  state_ = std::make_unique<State>(run, options);
  (void)state_->camera(View::kAnterior);  // says at once where there is nothing to draw
}
KneePictures::~KneePictures() = default;
KneePictures::KneePictures(KneePictures&&) noexcept = default;
KneePictures& KneePictures::operator=(KneePictures&&) noexcept = default;

const Camera& KneePictures::camera(View view) const { return state_->camera(view); }

KneePictures::Drawn KneePictures::draw_shown(View view, std::size_t pose) {
  const PoseResult& result = state_->run.sweep.poses.at(pose);
  assert(has_place(result));
  Scenery shown = state_->scenery(view, result);
  const std::vector<Item> items = state_->items(shown);
  const PageLayout& page = state_->page;
  Image image = state_->renderer.render(shown.camera, items, {page.drawing, page.fade});
  return {std::move(image), std::move(shown)};
}

Image KneePictures::draw(View view, std::size_t pose) {
  Drawn drawn = draw_shown(view, pose);
  if (state_->options.words && !state_->options.panel)
    annotate(drawn.image, state_->page, drawn.shown);
  return std::move(drawn.image);
}

Image draw_knee(const Run& run, View view, std::size_t pose, const PictureOptions& options) {
  return KneePictures(run, options).draw(view, pose);
}

}  // namespace condyle
