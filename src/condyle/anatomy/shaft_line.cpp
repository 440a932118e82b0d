#include "condyle/anatomy/shaft_line.h"

#include <algorithm>
#include <vector>

#include "condyle/anatomy/cross_section.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr int kSections = 16;
constexpr double kLeastArea = 150, kMostArea = 4500;  // of a shaft's section near a knee [mm²]
constexpr std::size_t kAtCut = 2;
constexpr double kShrink = 0.9;       // from section to section: less is the end of the bone
constexpr double kMostOpening = 0.1;  // of the length of an outline

bool is_shaft(const SectionLoop& loop) {
  return loop.area > kLeastArea && loop.area < kMostArea &&
         loop.opening < kMostOpening * loop.length;
}

}  // namespace

std::optional<ShaftLine> find_shaft_line(const TriangleMesh& mesh,
                                         const Vector3d& start,
                                         const Vector3d& along,
                                         const ShaftStretch& stretch) {
  const double step = (stretch.last - stretch.first) / kSections;
  std::vector<Vector3d> centers;
  double area = 0;
  for (int i = 0; i <= kSections; ++i) {
    const std::vector<SectionLoop> loops =
        cross_section(mesh, start + (stretch.first + i * step) * along, along);
    if (loops.empty() || !is_shaft(loops.front()) || loops.front().area < kShrink * area) break;
    area = loops.front().area;
    centers.push_back(loops.front().centroid);
  }
  // Near a cut that is not at right angles sections are partial.
  if (centers.size() <= kSections)
    centers.resize(centers.size() - std::min<std::size_t>(centers.size(), kAtCut));
  if (centers.size() < 2) return std::nullopt;
  const double length = step * (static_cast<double>(centers.size()) - 1);
  if (length < stretch.least) return std::nullopt;
  Vector3d sum = Vector3d::Zero();
  const double middle = (static_cast<double>(centers.size()) - 1) / 2;
  for (std::size_t i = 0; i < centers.size(); ++i)
    sum += (static_cast<double>(i) - middle) * (centers[i] - centers[0]);
  return ShaftLine{sum.normalized(), length};
}

}  // namespace condyle
