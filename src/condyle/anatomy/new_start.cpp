#include "condyle/anatomy/new_start.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "condyle/anatomy/new_scene_text.h"
#include "condyle/input_error.h"
#include "condyle/math/degree.h"
#include "condyle/math/rotation.h"
#include "condyle/scene/start_pose.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/start_gap.h"
#include "condyle/surface/offset_patch.h"

namespace condyle {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kAsScanned = 5 * kDegree;  // flexion that is left as it is
constexpr double kMostOverlap = 10;         // of bones that were scanned in one piece [mm]
constexpr double kTouch = 0.02;             // [mm]
constexpr double kMostTilt = 4 * kDegree;
constexpr double kMostShift = 1.5;        // along the tibia, beyond it a doubt [mm]
constexpr double kMostCartilage = 4;      // that an offset stands for [mm]
constexpr double kLeastCartilage = 0.15;  // [mm]

using Offsets = std::array<double, 4>;

/// Gaps of both compartments at a pose of the tibia, with the offsets taken off.
class Gaps {
 public:
  explicit Gaps(Scene scene) : scene_(std::move(scene)), surfaces_(fit_surfaces(scene_)) {}

  [[nodiscard]] Vector2d at(const RigidTransform& X_FT) {
    BodyDescription& tibia = scene_.bodies[static_cast<std::size_t>(scene_.moving_body())];
    tibia.start_translation = X_FT.p;
    tibia.start_rotation = log_rotation(X_FT.R);
    Vector2d gaps;
    for (int c = 0; c < 2; ++c) {
      const auto k = static_cast<std::size_t>(c);
      gaps[c] =
          start_gap(scene_, surfaces_, scene_.contacts[k]) - offset_[2 * k] - offset_[2 * k + 1];
    }
    return gaps;
  }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  /// That a surface can be moved out without coming near to folding over [mm].
  [[nodiscard]] double most_offset(std::size_t surface) const {
    const auto* patch = dynamic_cast<const Patch*>(surfaces_[surface].surface.get());
    return patch == nullptr ? 0 : kOfHollow * sharpest_hollow(*patch).radius;
  }
  void set_offset(const Offsets& offset) { offset_ = offset; }
  [[nodiscard]] const std::vector<FittedSurface>& surfaces() const { return surfaces_; }

 private:
  static constexpr double kOfHollow = 0.7;
  Scene scene_;
  std::vector<FittedSurface> surfaces_;
  Offsets offset_{};
};

/// Half of each gap between bare bones is taken for each cartilage, what cannot be cartilage for 2
/// mm; what a hollow of one surface has no room for the other one takes.
Offsets cartilage_offsets(const Gaps& gaps, const Vector2d& gap) {
  Offsets offset{};
  for (std::size_t c = 0; c < 2; ++c) {
    const double half = gap[static_cast<int>(c)] / 2;
    if (!std::isfinite(half) || !(half > kLeastCartilage)) continue;
    const double wanted = half > kMostCartilage ? 2 : half;
    const double plateau = std::min(wanted, gaps.most_offset(2 * c + 1));
    const double condyle = std::min(2 * wanted - plateau, gaps.most_offset(2 * c));
    offset[2 * c] = std::floor(20 * condyle) / 20;
    offset[2 * c + 1] = std::floor(20 * plateau) / 20;
  }
  return offset;
}

RigidTransform moved(const JointFrames& frames, JointCoordinates q, const Vector2d& step) {
  q.distraction += step.x();
  q.adduction += step.y();
  return pose_from_joint_coordinates(frames, q);
}

/// Distraction and adduction that close both gaps (Newton, by differences); the least gap alone
/// where that would take more than kMostTilt.
Vector2d close_gaps(Gaps& gaps, const JointFrames& frames, const JointCoordinates& q) {
  Vector2d step = Vector2d::Zero();
  for (int iteration = 0; iteration < 12; ++iteration) {
    const Vector2d g = gaps.at(moved(frames, q, step));
    if (!g.allFinite()) break;
    if (g.cwiseAbs().maxCoeff() < kTouch) return step;
    Matrix2d slope;
    for (int k = 0; k < 2; ++k) {
      const double h = k == 0 ? 0.2 : 0.2 * kDegree;
      Vector2d there = step;
      there[k] += h;
      slope.col(k) = (gaps.at(moved(frames, q, there)) - g) / h;
    }
    if (!slope.allFinite() || std::abs(slope.determinant()) < 1e-3) break;
    step -= slope.inverse() * g;
    if (std::abs(step.y()) > kMostTilt) break;
  }
  step.setZero();
  Vector2d touching = step;  // the last at which the surfaces faced each other
  for (int iteration = 0; iteration < 8; ++iteration) {
    const double least = gaps.at(moved(frames, q, step)).minCoeff();
    if (!std::isfinite(least)) return touching;
    touching = step;
    if (std::abs(least) < kTouch) break;
    step.x() -= least;
  }
  return touching;
}

/// A bone with its cartilage in one mesh, or with what lies within it.
void doubt_sheets(NewKnee& knee, const std::vector<FittedSurface>& surfaces) {
  std::string where;
  for (const FittedSurface& surface : surfaces)
    if (surface.report && surface.report->sheet_below > 0)
      where += fmt::format("{}{:.1f} mm ({})", where.empty() ? "" : ", ",
                           surface.report->sheet_below, surface.report->surface);
  if (!where.empty())
    knee.doubts.push_back(
        fmt::format("a mesh has two surfaces over each other, the inner one by {} below: the outer "
                    "one is taken; cartilage comes in a "
                    "mesh of its own (--cartilage)",
                    where));
}

void doubt_start(NewKnee& knee, bool bare, const Vector2d& after) {
  const NewStart& start = knee.start;
  if (start.extended != 0)
    knee.doubts.push_back(fmt::format(
        "the start pose is {:.0f} degrees {} than the scan, turned about the femur's axis: there "
        "the template has its strains",
        std::abs(start.extended) / kDegree, start.extended > 0 ? "straighter" : "more flexed"));
  for (std::size_t c = 0; c < 2; ++c) {
    const char* side = c == 0 ? "medial" : "lateral";
    if (!std::isfinite(start.gaps[c]))
      knee.doubts.push_back(
          fmt::format("the {} surfaces do not face each other at the start pose", side));
    else if (start.gaps[c] < -1)
      knee.doubts.push_back(
          fmt::format("the {} surfaces overlap by {:.1f} mm {}", side, -start.gaps[c],
                      start.extended != 0 ? "once at the template's flexion" : "in the scan"));
    else if (!std::isfinite(after[static_cast<int>(c)]))
      knee.doubts.push_back(
          fmt::format("the {} surfaces do not face each other once brought together", side));
    else if (after[static_cast<int>(c)] < -0.1)
      knee.doubts.push_back(
          fmt::format("the {} surfaces still overlap by {:.1f} mm at the start pose", side,
                      -after[static_cast<int>(c)]));
    else if (after[static_cast<int>(c)] > 1)
      knee.doubts.push_back(
          fmt::format("a gap of {:.1f} mm stays between the {} surfaces at the start pose",
                      after[static_cast<int>(c)], side));
  }
  if (bare && *std::max_element(start.offset.begin(), start.offset.end()) > 0)
    knee.doubts.push_back(fmt::format(
        "no cartilage was given: the bones' surfaces are moved out by {:.2f} (femur) "
        "and {:.2f} mm (tibia) medially, "
        "{:.2f} and {:.2f} mm laterally, so that they meet; poses may be lost by that, which "
        "the meshes of the cartilage find",
        start.offset[0], start.offset[1], start.offset[2], start.offset[3]));
  if (std::abs(start.shifted) > kMostShift)
    knee.doubts.push_back(fmt::format("the bones are brought {} by {:.1f} mm",
                                      start.shifted > 0 ? "together" : "apart",
                                      std::abs(start.shifted)));
  if (std::abs(start.tilted) > 2 * kDegree)
    knee.doubts.push_back(fmt::format(
        "{:.1f} degrees of {} are added so that both compartments touch",
        std::abs(start.tilted) / kDegree, start.tilted > 0 ? "adduction" : "abduction"));
}

Gaps gaps_of(const NewKnee& knee) {
  try {
    return Gaps(scene_of(knee));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} and {} make no knee: {}", knee.files.femur.string(),
                                 knee.files.tibia.string(), without_file(error.what())));
  }
}

}  // namespace

void find_start(NewKnee& knee) {
  Gaps gaps = gaps_of(knee);
  const JointFrames frames = joint_frames(gaps.scene());
  NewStart& start = knee.start;
  start.scan = joint_coordinates(frames, RigidTransform{});
  JointCoordinates q = start.scan;
  const double excess = q.flexion - knee.model.start.flexion;
  if (std::abs(excess) > kAsScanned) {
    start.extended = excess;
    q.flexion = knee.model.start.flexion;
  }
  const Vector2d before = gaps.at(pose_from_joint_coordinates(frames, q));
  start.gaps = {before[0], before[1]};
  if (before.minCoeff() < -kMostOverlap)
    throw InputError(fmt::format(
        "{} and {}: the bones lie {:.0f} mm inside each other, expected them as scanned",
        knee.files.femur.string(), knee.files.tibia.string(), -before.minCoeff()));
  doubt_sheets(knee, gaps.surfaces());
  const bool bare = knee.files.cartilage.empty();
  if (bare) gaps.set_offset(start.offset = cartilage_offsets(gaps, before));
  const Vector2d step = close_gaps(gaps, frames, q);
  start.shifted = -step.x();
  start.tilted = step.y();
  start.X_FT = moved(frames, q, step);
  doubt_start(knee, bare, gaps.at(start.X_FT));
}

}  // namespace condyle
