#include "pictures/knee_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "input_error.h"
#include "pictures/annotate.h"
#include "pictures/knee_shapes.h"
#include "pictures/renderer.h"
#include "pictures/seen_from_above.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kShaftReach = 1.2;  // how much farther than the insertions bone is kept in view
constexpr std::size_t kFramePoints = 1500;  // of each shape that decide the frame

struct KeptShape {
  int body;
  Item item;
  std::vector<Vector3d> outline;  // some of its vertices, body frame
};

std::vector<Vector3d> some_vertices(const ShadedMesh& mesh) {
  std::vector<Vector3d> points;
  const std::size_t stride = std::max<std::size_t>(1, mesh.vertices.size() / kFramePoints);
  for (std::size_t i = 0; i < mesh.vertices.size(); i += stride)
    points.push_back(mesh.vertices[i].position.cast<double>());
  return points;
}

void check_size(const PictureOptions& options) {
  const auto good = [](int size) { return size >= 200 && size <= 8000; };
  if (good(options.width) && good(options.height)) return;
  throw InputError(fmt::format("picture size {}x{}, expected 200 to 8000 pixels each way",
                               options.width, options.height));
}

}  // namespace

struct KneePictures::State {
  const Run& run;
  PictureOptions options;
  PageLayout page;
  PictureScales scales;
  Renderer renderer;
  std::vector<KeptShape> shapes;
  int path = -1, reference_path = -1, ligaments = -1, contacts = -1, arrows = -1;
  std::vector<bool> seen;  // insertions on the tibia, from above
  std::array<Camera, kViewCount> cameras;

  State(const Run& r, const PictureOptions& o)
      : run(r),
        options(o),
        page(page_layout(o.width, o.height)),
        scales(picture_scales(r)),
        renderer(o.width, o.height) {
    const std::vector<BodyShape> all = body_shapes(run);
    seen = seen_from_above(run.scene, all);
    for (const BodyShape& shape : all) {
      shapes.push_back({shape.body,
                        {renderer.add(shape.mesh), {}, shape.layer, shape.gloss, shape.closed},
                        some_vertices(shape.mesh)});
    }
    path = renderer.add(contact_paths(run, scales));
    reference_path = renderer.add(reference_paths(run));
    for (int* id : {&ligaments, &contacts, &arrows}) *id = renderer.add({});
    for (int i = 0; i < kViewCount; ++i)
      cameras[static_cast<std::size_t>(i)] = frame_all(static_cast<View>(i));
  }

  [[nodiscard]] std::vector<Vector3d> anchors(const PoseResult& pose, bool tibia_only) const;
  [[nodiscard]] std::vector<Vector3d> points_in_view(const PoseResult& pose, bool tibia_only) const;
  [[nodiscard]] Camera frame_all(View view) const;
  [[nodiscard]] std::vector<Item> items(View view, const PoseResult& pose);
};

/// What must be in the picture: insertions and articular surfaces.
std::vector<Vector3d> KneePictures::State::anchors(const PoseResult& pose, bool tibia_only) const {
  const auto X_P = body_poses(run.scene, pose.X_BA);
  const int tibia = tibia_body(run.scene);
  std::vector<Vector3d> points;
  for (const LigamentDescription& ligament : run.scene.ligaments) {
    for (const Attachment& end : ligament.ends) {
      if (!tibia_only || end.body == tibia)
        points.push_back(X_P[static_cast<std::size_t>(end.body)] * end.at);
    }
  }
  for (const KeptShape& shape : shapes) {
    if (shape.item.layer != Layer::kSolid || (tibia_only && shape.body != tibia)) continue;
    for (const Vector3d& p : shape.outline)
      points.push_back(X_P[static_cast<std::size_t>(shape.body)] * p);
  }
  return points;
}

/// The same and the bone around it, without the far ends of long shafts.
std::vector<Vector3d> KneePictures::State::points_in_view(const PoseResult& pose,
                                                          bool tibia_only) const {
  std::vector<Vector3d> points = anchors(pose, tibia_only);
  Vector3d middle = Vector3d::Zero();
  for (const Vector3d& p : points) middle += p / static_cast<double>(points.size());
  double reach = points.empty() ? 1e9 : 0;
  for (const Vector3d& p : points) reach = std::max(reach, kShaftReach * (p - middle).norm());
  const auto X_P = body_poses(run.scene, pose.X_BA);
  for (const KeptShape& shape : shapes) {
    if (shape.item.layer != Layer::kBone || (tibia_only && shape.body != tibia_body(run.scene)))
      continue;
    for (const Vector3d& p : shape.outline) {
      const Vector3d q = X_P[static_cast<std::size_t>(shape.body)] * p;
      if ((q - middle).norm() < reach) points.push_back(q);
    }
  }
  return points;
}

Camera KneePictures::State::frame_all(View view) const {
  std::vector<Vector3d> points;
  for (const PoseResult& pose : run.sweep.poses) {
    if (!pose.converged()) continue;
    const auto more = points_in_view(pose, view == View::kPlateau);
    points.insert(points.end(), more.begin(), more.end());
    if (view == View::kPlateau) break;  // the tibia stands still
  }
  if (points.empty())
    throw InputError(
        "nothing to draw: the run has no converged pose, or neither meshes nor ligaments");
  return fit_camera(view_rotation(view, anatomy_of(run.scene)), points, page.drawing);
}

std::vector<Item> KneePictures::State::items(View view, const PoseResult& pose) {
  const auto X_P = body_poses(run.scene, pose.X_BA);
  const bool tibia_only = view == View::kPlateau;
  const std::vector<ContactMark> marks = contact_marks(run.scene, pose);
  renderer.replace(ligaments, tibia_only ? tibial_insertions(run, pose, scales)
                                         : ligament_tubes(run, pose, scales));
  renderer.replace(contacts, contact_points(marks));
  renderer.replace(arrows, tibia_only ? ShadedMesh{} : force_arrows(marks, scales));
  std::vector<Item> items;
  for (const KeptShape& shape : shapes) {
    if (tibia_only && shape.body != tibia_body(run.scene)) continue;
    items.push_back(shape.item);
    items.back().X_PM = X_P[static_cast<std::size_t>(shape.body)];
  }
  for (const int mesh : {path, reference_path, ligaments})
    items.push_back({mesh, {}, Layer::kSolid, 0.12, true});
  for (const int mesh : {contacts, arrows}) items.push_back({mesh, {}, Layer::kMark, 0.12, true});
  return items;
}

KneePictures::KneePictures(const Run& run, const PictureOptions& options) {
  check_size(options);
  state_ = std::make_unique<State>(run, options);
}
KneePictures::~KneePictures() = default;
KneePictures::KneePictures(KneePictures&&) noexcept = default;
KneePictures& KneePictures::operator=(KneePictures&&) noexcept = default;

Camera KneePictures::camera(View view) const {
  return state_->cameras[static_cast<std::size_t>(view)];
}

Image KneePictures::draw(View view, std::size_t pose) {
  const PoseResult& shown = state_->run.sweep.poses.at(pose);
  assert(shown.converged());
  Image image = state_->renderer.render(camera(view), state_->items(view, shown));
  if (state_->options.words)
    annotate(image, state_->page,
             {state_->run, shown, view, camera(view), state_->scales, state_->seen});
  return image;
}

Image draw_knee(const Run& run, View view, std::size_t pose, const PictureOptions& options) {
  return KneePictures(run, options).draw(view, pose);
}

}  // namespace condyle
