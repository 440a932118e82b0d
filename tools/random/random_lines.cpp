#include <fmt/format.h>

#include <Eigen/Geometry>

#include <cmath>

#include "condyle/math/rotation.h"
#include "random/random_knee.h"

namespace condyle::random_knees {
namespace {

using Eigen::Vector3d;

int line_count(Draws& draws) {
  const double u = draws.unit();
  if (u < 0.05) return 0;
  if (u < 0.2) return 1 + draws.below(4);
  if (u < 0.9) return 5 + draws.below(16);
  return 21 + draws.below(40);
}

/// Of a line that is so long while the joint is closed [mm].
ForceLaw law(Draws& draws, double length, double size, std::optional<double>& strain) {
  const double slack = length / (1 + draws.between(-0.1, 0.06));
  if (draws.chance(0.6)) strain = draws.between(-0.08, 0.06);
  switch (draws.below(6)) {
    case 0:
      return QuadraticLaw{size * draws.of_any_size(1, 60), slack};
    case 1: {
      strain.reset();
      const double k = size * draws.of_any_size(0.5, 100);
      return PolynomialLaw{{-k * slack, k}, draws.chance(0.7)};
    }
    case 2: {
      strain.reset();
      std::vector<double> lengths, forces;
      for (int i = 0; i < 5; ++i) {
        lengths.push_back(slack * (0.9 + 0.06 * i));
        // cppcheck-suppress containerOutOfBounds ; asked only from the second on
        forces.push_back(i == 0 ? 0 : forces.back() + size * draws.between(0, 100) * i);
      }
      return make_table_law(lengths, forces);
    }
    default:
      return ToeLinearLaw{size * draws.of_any_size(200, 5000), draws.between(0.02, 0.08), slack};
  }
}

WrapShape shape(Draws& draws, double radius) {
  switch (draws.below(4)) {
    case 0:
      return WrapSphere{radius};
    case 1:
      return WrapCylinder{radius};
    case 2:
      return WrapEllipsoid{
          {radius, radius * draws.between(0.4, 1), radius * draws.between(0.4, 1)}};
    default:
      return WrapTorus{radius * 0.6, radius * 0.4};
  }
}

}  // namespace

void add_lines(Draws& draws, RandomKnee& knee) {
  const bool strange = knee.ill == Ill::kStiffness;
  const int count = line_count(draws);
  for (int i = 0; i < count; ++i) {
    LigamentDescription line;
    line.name = fmt::format("line {}", i + 1);
    Vector3d up = draws.within(30), down = up + draws.within(12);
    up.z() = draws.between(6, 30);
    down.z() = -draws.between(6, 30);
    line.ends = {Attachment{1, up}, Attachment{0, down}};
    if (draws.chance(0.5)) std::swap(line.ends[0], line.ends[1]);
    const double size = strange ? draws.of_any_size(1e-9, 1e9) : 1;
    line.law = law(draws, (up - down).norm(), size, line.reference_strain);
    if (knee.ill == Ill::kAllSlack) {
      line.reference_strain.reset();
      line.law = ToeLinearLaw{1000, 0.06, 3 * (up - down).norm()};
    }
    knee.scene.ligaments.push_back(line);
  }
  if (knee.ill == Ill::kZeroLength) {
    LigamentDescription line;
    line.name = "short line";
    const Vector3d at = draws.within(10);
    line.ends = {Attachment{1, at}, Attachment{0, at + (draws.chance(0.5) ? 0 : 1e-9) * at}};
    line.law = PolynomialLaw{{0, draws.between(1, 20)}, false};
    knee.scene.ligaments.push_back(line);
  }
}

/// Beside the middle part of a line, on either body, no wider than leaves both ends outside.
void add_wraps(Draws& draws, RandomKnee& knee) {
  if (knee.scene.ligaments.empty() || !draws.chance(0.3)) return;
  const int count = 1 + draws.below(4);
  for (int i = 0; i < count; ++i) {
    LigamentDescription& line = knee.scene.ligaments[static_cast<std::size_t>(
        draws.below(static_cast<int>(knee.scene.ligaments.size())))];
    const Vector3d &p = line.ends[0].at, &q = line.ends[1].at;
    if (line.path.wraps.size() > 1 || (q - p).norm() < 5) continue;
    const double t = line.path.wraps.empty() ? draws.between(0.2, 0.5) : draws.between(0.5, 0.8);
    const double radius = draws.between(0.3, 0.9) * std::min(t, 1 - t) * (q - p).norm();
    WrapDescription wrap;
    wrap.name = fmt::format("wrap {}", i + 1);
    wrap.body = draws.below(2);
    wrap.shape = shape(draws, radius);
    const Vector3d aside = (q - p).cross(draws.direction()).normalized();
    wrap.placement.p = p + t * (q - p) + draws.between(0.2, 1.2) * radius * aside;
    wrap.placement.R = draws.rotation();
    if (std::holds_alternative<WrapCylinder>(wrap.shape)) {
      // Across the line.
      wrap.placement.R.col(2) = (q - p).cross(aside).normalized();
      wrap.placement.R.col(0) = aside;
      wrap.placement.R.col(1) = wrap.placement.R.col(2).cross(aside);
    }
    line.path.wraps.push_back(static_cast<int>(knee.scene.wraps.size()));
    line.path.anchors_inside = draws.chance(0.8);
    if (draws.chance(0.2)) line.path.thickness = draws.between(0, 1);
    knee.scene.wraps.push_back(wrap);
  }
}

}  // namespace condyle::random_knees
