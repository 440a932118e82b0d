#include "condyle/pictures/fit_picture.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <string>

#include "condyle/pictures/annotate.h"
#include "condyle/pictures/color_bar.h"
#include "condyle/pictures/fit_map.h"
#include "condyle/pictures/renderer.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kPanelWidth = 520, kPanelHeight = 500;  // [pixel]
constexpr int kHead = 90, kFoot = 70, kBars = 130;    // of the page around the panels
constexpr double kPanelMargin = 35;
constexpr double kTwoSides = 50 * M_PI / 180;  // between the halves of a patch seen from two sides

Anatomy anatomy_of_body(const Scene& scene, int body) {
  if (!scene.joint) return anatomy_of(scene);
  const JointDescription& joint = *scene.joint;
  const AnatomicalFrame& frame = body == joint.femur.body ? joint.femur : joint.tibia;
  return {frame.lateral, frame.anterior, frame.proximal};
}

/// Rows right, up, back for eyes that look against `normal`; proximal or anterior is up.
Matrix3d looking_at(const Vector3d& normal, const Anatomy& anatomy) {
  const bool flat = std::abs(normal.dot(anatomy.proximal)) > std::abs(normal.dot(anatomy.anterior));
  Matrix3d R;
  R.row(2) = normal;
  R.row(0) = (flat ? anatomy.anterior : anatomy.proximal).cross(normal).normalized();
  R.row(1) = normal.cross(R.row(0).transpose());
  return R;
}

/// Where the known part is looked at from: along its mean normal, or along those of both halves.
std::vector<Vector3d> sides(const Patch& patch) {
  Vector3d halves[2] = {Vector3d::Zero(), Vector3d::Zero()};
  const double middle = (patch.u_min() + patch.u_max()) / 2;
  for (const Place& place : patch.samples(1.5))
    if (patch.edge_distance(place) >= 0)
      halves[place.numbers.x() > middle] += patch.evaluate(place).n;
  if (halves[0].isZero() || halves[1].isZero()) return {(halves[0] + halves[1]).normalized()};
  const Vector3d a = halves[0].normalized(), b = halves[1].normalized();
  if (std::acos(std::clamp(a.dot(b), -1.0, 1.0)) < kTwoSides) return {(a + b).normalized()};
  return {a, b};
}

struct Page {
  const Scene& scene;
  const FittedSurface& fitted;
  int body;
  std::vector<FitMap> maps;  ///< with the same colours
  std::string caption;
};

std::vector<Vector3d> positions(const ShadedMesh& mesh) {
  std::vector<Vector3d> points;
  for (const ShadedVertex& vertex : mesh.vertices) points.push_back(vertex.position.cast<double>());
  return points;
}

/// Cameras of all sides, to one scale.
std::vector<Camera> cameras_of(const Page& page, const Patch& patch, const ShadedMesh& mesh) {
  const Anatomy anatomy = anatomy_of_body(page.scene, page.body);
  std::vector<Camera> cameras;
  double scale = 0;
  for (const Vector3d& side : sides(patch)) {
    cameras.push_back(fit_camera(
        looking_at(side, anatomy), positions(mesh),
        {kPanelMargin, kPanelMargin, kPanelWidth - kPanelMargin, kPanelHeight - kPanelMargin}));
    scale = std::max(scale, cameras.back().mm_per_pixel);
  }
  for (Camera& camera : cameras) camera.mm_per_pixel = scale;
  return cameras;
}

/// A cross with the letters of the anatomical directions, lower left in a panel.
void draw_cross(const Pen& pen,
                const Eigen::Vector2d& middle,
                const Camera& camera,
                const Anatomy& anatomy) {
  for (int axis = 0; axis < 2; ++axis)
    for (const double sign : {1.0, -1.0}) {
      const Eigen::Vector2d out = axis == 0 ? Eigen::Vector2d(sign, 0) : Eigen::Vector2d(0, -sign);
      pen.canvas.line(middle, middle + 18 * out, 1.4, kLeader);
      pen.canvas.text(middle + 29 * out + Eigen::Vector2d(0, 5),
                      direction_letter(anatomy, sign * camera.R_VP.row(axis)),
                      pen.style(15, kInk, Align::kCenter));
    }
}

void draw_scale(const Pen& pen, double mm_per_pixel, double bottom) {
  const double pixels = 10 / mm_per_pixel;
  pen.canvas.rectangle({30, bottom - 32, 30 + pixels, bottom - 28}, kInk);
  pen.canvas.text({30 + pixels / 2, bottom - 39}, "10 mm", pen.style(14, kInk, Align::kCenter));
}

/// Maps of a patch that is seen from one side stand side by side, else one below the other.
struct Panel {
  int map, side, column, row;
};
std::vector<Panel> lay_out(int maps, int sides) {
  std::vector<Panel> panels;
  for (int map = 0; map < maps; ++map)
    for (int side = 0; side < sides; ++side)
      panels.push_back(sides == 1 ? Panel{map, side, map, 0} : Panel{map, side, side, map});
  return panels;
}

/// A thin line where a shape ends: most of a good map is as white as the paper.
void draw_outline(Image& panel, const Image& silhouette) {
  const auto paper = [&](int x, int y) { return silhouette.at(x, y)[0] > 200; };
  for (int y = 1; y + 1 < panel.height; ++y)
    for (int x = 1; x + 1 < panel.width; ++x)
      if (!paper(x, y) &&
          (paper(x - 1, y) || paper(x + 1, y) || paper(x, y - 1) || paper(x, y + 1)))
        std::copy_n(kQuiet.begin(), 3,
                    panel.rgb.begin() + static_cast<std::ptrdiff_t>(panel.offset(x, y)));
}

Image draw_panel(Renderer& renderer, int slot, const Camera& camera, ShadedMesh mesh) {
  const std::vector<Item> items = {{slot, {}, Layer::kSolid, 0, false}};
  renderer.replace(slot, mesh);
  Image panel = renderer.render(camera, items);
  for (ShadedVertex& vertex : mesh.vertices) vertex.color = bytes({{0, 0, 0}});
  renderer.replace(slot, mesh);
  draw_outline(panel, renderer.render(camera, items));
  return panel;
}

Image draw_page(Renderer& renderer, int slot, const Page& page) {
  const auto& patch = dynamic_cast<const Patch&>(*page.fitted.surface);
  std::vector<ShadedMesh> meshes;
  for (const FitMap& map : page.maps) meshes.push_back(painted(patch, map));
  const std::vector<Camera> cameras = cameras_of(page, patch, meshes.front());
  const auto panels = lay_out(static_cast<int>(meshes.size()), static_cast<int>(cameras.size()));
  const int width = (panels.back().column + 1) * kPanelWidth + kBars,
            height = kHead + (panels.back().row + 1) * kPanelHeight + kFoot;
  Image image = blank_image(width, height, {255, 255, 255});
  for (const Panel& panel : panels)
    paste(draw_panel(renderer, slot, cameras[panel.side], meshes[panel.map]), image,
          panel.column * kPanelWidth, kHead + panel.row * kPanelHeight);
  Canvas canvas(image);
  const Pen pen{canvas, 1};
  draw_title(pen, width, capitalized(page.fitted.report->surface), page.caption);
  for (const Panel& panel : panels) {
    const Eigen::Vector2d corner(panel.column * kPanelWidth, kHead + panel.row * kPanelHeight);
    draw_cross(pen, corner + Eigen::Vector2d(60, kPanelHeight - 50), cameras[panel.side],
               anatomy_of_body(page.scene, page.body));
    if (panel.side == 0)
      pen.canvas.text(corner + Eigen::Vector2d(30, 22), page.maps[panel.map].panel, pen.style(15));
  }
  const FitMap& map = page.maps.front();
  const double left = width - kBars + 10, top = kHead + 90;
  draw_color_bar(pen,
                 {ColorMap::kDiverging, map.title, "[" + map.unit + "]", -map.limit, map.limit},
                 {left, top, left + 16, top + 300});
  draw_scale(pen, cameras.front().mm_per_pixel, height);
  return image;
}

/// A word for the names of a surface's files that none of the others has.
std::string file_word_of(std::string surface, std::set<std::string>& taken) {
  constexpr std::size_t kLongest = 100;  // of the 255 bytes that names of files have at most
  for (char& c : surface)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  surface.resize(std::min(surface.size(), kLongest));
  std::string word = surface;
  for (int k = 2; !taken.insert(word).second; ++k) word = fmt::format("{}_{}", surface, k);
  return word;
}

}  // namespace

std::vector<FitPicture> draw_fit(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  Renderer renderer(kPanelWidth, kPanelHeight);
  const int slot = renderer.add({});
  std::vector<FitPicture> pictures;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (!surfaces[i].report) continue;
    const FittedSurface& fitted = surfaces[i];
    const FitReport& report = *fitted.report;
    const auto& patch = dynamic_cast<const Patch&>(*fitted.surface);
    const int body = scene.surfaces[i].body;
    const std::string word = file_word_of(report.surface, taken);
    pictures.push_back(
        {word + "_deviation",
         draw_page(renderer, slot,
                   {scene,
                    fitted,
                    body,
                    {deviation_map(fitted)},
                    fmt::format("patch to mesh: rms {:.3f} mm, 95 % {:.3f} mm, greatest {:.3f} mm",
                                report.back_rms, report.back_p95, report.back_max)})});
    pictures.push_back(
        {word + "_curvature",
         draw_page(
             renderer, slot,
             {scene,
              fitted,
              body,
              {curvature_map(patch, Principal::kGreatest), curvature_map(patch, Principal::kLeast)},
              fmt::format("principal curvatures, in the core {:+.3f} to {:+.3f} per mm; "
                          "negative: round like a ball",
                          report.curvature_range[0], report.curvature_range[1])})});
  }
  return pictures;
}

}  // namespace condyle
