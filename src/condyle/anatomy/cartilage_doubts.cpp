#include "condyle/anatomy/cartilage_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "condyle/specimen/fit_wraps.h"
#include "condyle/surface/smoothed_mesh.h"

namespace condyle {
namespace {

constexpr double kDeep = 0.5;            // in the bone [mm]
constexpr double kMostDeep = 0.1;        // of the vertices
constexpr double kThick = 0.075;         // over the bone [its width]
constexpr double kMostThick = 0.05;      // of the vertices
constexpr std::size_t kVertices = 1000;  // that are looked at, about

/// Heights of cartilage over its bone [mm]; none where the bone is open.
std::vector<double> heights_over(const TriangleMesh& bone, const TriangleMesh& cartilage) {
  std::vector<double> heights;
  const std::optional<TriangleMesh> solid = solid_bone(bone);
  if (!solid) return heights;
  const SmoothedMesh surface(*solid);
  const std::size_t step = std::max<std::size_t>(1, cartilage.vertices.size() / kVertices);
  for (std::size_t i = 0; i < cartilage.vertices.size(); i += step)
    heights.push_back(surface.signed_distance(cartilage.vertices[i]));
  return heights;
}

void doubt(const TriangleMesh& bone,
           const std::optional<TriangleMesh>& cartilage,
           double width,
           const char* name,
           std::vector<std::string>& doubts) {
  if (!cartilage) return;
  const std::vector<double> heights = heights_over(bone, *cartilage);
  if (heights.empty()) return;
  const auto part = [&](const auto& is) {
    return static_cast<double>(std::count_if(heights.begin(), heights.end(), is)) /
           static_cast<double>(heights.size());
  };
  constexpr const char* kAsk = "is it of this knee, and in one frame with it?";
  const double deep = part([](double h) { return h < -kDeep; }),
               high = part([&](double h) { return h > kThick * width; });
  if (deep > kMostDeep)
    doubts.push_back(
        fmt::format("{:.0f} % of the {} cartilage lies more than {:g} mm deep in its bone: {}",
                    100 * deep, name, kDeep, kAsk));
  else if (high > kMostThick)
    doubts.push_back(
        fmt::format("{:.0f} % of the {} cartilage lies more than {:.1f} mm over its bone: {}",
                    100 * high, name, kThick * width, kAsk));
}

}  // namespace

std::vector<std::string> cartilage_doubts(const KneeMeshes& meshes, const RecognisedKnee& shape) {
  std::vector<std::string> doubts;
  doubt(meshes.femur, meshes.femoral_cartilage, shape.femur.width, "femoral", doubts);
  doubt(meshes.tibia, meshes.tibial_cartilage, shape.tibia.width, "tibial", doubts);
  return doubts;
}

}  // namespace condyle
