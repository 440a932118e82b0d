#pragma once

/// One number that a pose tells (PoseResult), with its derivative: a row by the unknowns of Newton's
/// system, and what it depends on a parameter by itself (parameter_effect.h). Units and frames are
/// those of PoseResult: mm, N, rad, the frames of the files. A laxity is the difference of a joint
/// coordinate at two poses, its derivative the difference of both derivatives.
///
///   kJointCoordinate    index 0 to 5: flexion, adduction, internal rotation; lateral shift, anterior
///                       drawer, distraction
///   kContactForce       ContactResult::force of a pair
///   kContactResultant   a component of ContactResult::resultant_ground; of a layer the centre of
///                       pressure
///   kPointForce         of one point of a pair of rigid surfaces
///   kPointGround        a component of point_ground,
///   kPointMoving        of point_moving
///   kLayerForce         a component of LayerResult::force,
///   kLayerMoment        of LayerResult::moment
///   kLigamentLength, kLigamentStrain, kLigamentForce
///   kMultiplier         of a condition

#include <string>

#include "condyle/equilibrium/parameter_effect.h"
#include "condyle/equilibrium/pose_result.h"

namespace condyle {

enum class OutputKind {
  kJointCoordinate,
  kContactForce,
  kContactResultant,
  kPointForce,
  kPointGround,
  kPointMoving,
  kLayerForce,
  kLayerMoment,
  kLigamentLength,
  kLigamentStrain,
  kLigamentForce,
  kMultiplier
};

struct PoseOutput {
  OutputKind kind = OutputKind::kJointCoordinate;
  std::size_t index = 0;  ///< coordinate, pair, ligament or condition
  int component = 0;      ///< 0 x, 1 y, 2 z
  std::size_t point = 0;  ///< of ContactResult::points
};

/// What the pose tells; NaN where it has no such number.
[[nodiscard]] double value_of(const PoseOutput& output, const PoseResult& pose);

/// By (da, L dπ, dp, dσ/w), as the columns of NewtonSystem::fill.
using OutputRow = std::array<double, SmallLu::kMaxSize>;

/// Throws std::invalid_argument with one sentence where the pose has no such number, or nothing says
/// how it changes: the place of a contact that is open, one of the ends of a line of contact. The
/// force of an open contact is 0 and stays so.
void find_row(const PoseOutput& output, LocalRates& rates, OutputRow& row);

/// Of the output at a fixed state; `output` is one that has a row.
[[nodiscard]] double explicit_part(const PoseOutput& output,
                                   LocalRates& rates,
                                   const ParameterEffect& effect);

}  // namespace condyle
