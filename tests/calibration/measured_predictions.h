#pragma once

/// A knee with a table of all kinds of rows, and the check of predictions' derivatives by differences of
/// evaluations.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "condyle/calibration/predictions.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/measured_knee.h"
#include "support/random.h"

namespace condyle::test {

/// A knee with its table and the numbers that are free.
struct Measured {
  Scene scene = measured_knee();
  MeasurementTable table;
  std::vector<FreeParameter> parameters;

  Measured() { table.file = "knee.csv"; }
  [[nodiscard]] Predictions predictions() const {
    return {scene, fit_surfaces(scene), table, parameters};
  }
  Measurement& add_row(
      MeasuredKind kind, std::size_t index, int load, double level, double flexion) {
    Measurement row;
    row.line = static_cast<int>(table.rows.size()) + 2;
    row.test = "forces";
    row.flexion = flexion * kDegree;
    row.load = load;
    row.level = level;
    row.kind = kind;
    row.index = index;
    return table.rows.emplace_back(row);
  }
};

/// Coordinates, reaction and forces under both kinds of control, told absolutely and relatively.
inline Measured all_kinds() {
  Measured knee;
  knee.scene.calibration->relative = {"varus", "drawn"};
  add_coordinates("passive", 20 * kDegree, -1, 0, knee.table);
  add_coordinates("anterior", 20 * kDegree, 0, 80, knee.table);
  add_coordinates("varus", 20 * kDegree, 1, -6000, knee.table);
  add_coordinates("drawn", 20 * kDegree, 3, -9, knee.table);
  for (const int load : {0, 3}) {
    const double level = load == 0 ? 80 : -9;
    for (const std::size_t ligament : {0, 1, 3, 5, 8})
      knee.add_row(MeasuredKind::kLigamentForce, ligament, load, level, 20);
    for (const std::size_t contact : {0, 1})
      knee.add_row(MeasuredKind::kContactForce, contact, load, level, 20);
  }
  knee.add_row(MeasuredKind::kReaction, 0, 3, -9, 20);
  for (const std::size_t coordinate : {2, 4})
    knee.add_row(MeasuredKind::kJointCoordinate, coordinate, 0, 80, 20).laxity = true;
  return knee;
}

/// Rows that are compared with each other: of one kind, angles apart from lengths.
inline int group_of(const Measurement& row) {
  const bool angle = row.kind == MeasuredKind::kJointCoordinate && row.index < 3;
  return angle ? -1 : static_cast<int>(row.kind);
}

inline double step_of(const FreeParameter& parameter) {
  if (parameter.kind == FreeParameter::Kind::kCurveOffset) return 1e-2;
  if (parameter.kind != FreeParameter::Kind::kNumber) return parameter.component < 3 ? 0.05 : 1e-3;
  switch (parameter.moves[0].first.kind) {
    case ParameterKind::kReferenceStrain:
    case ParameterKind::kTransitionStrain:
      return 1e-4;
    case ParameterKind::kStiffness:
    case ParameterKind::kLoadScale:
      return 1e-3;
    default:
      return 3e-3;  // mm
  }
}

/// Every column by differences of fourth order, relative to the greatest entry of the row's group.
inline void expect_exact(const Measured& knee, const Eigen::VectorXd& theta, double h = 1) {
  Predictions predictions = knee.predictions();
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
  ASSERT_TRUE(predictions.evaluate(theta, y, &J)) << predictions.failure();
  ASSERT_EQ(J.cols(), static_cast<Eigen::Index>(knee.parameters.size()));
  ASSERT_TRUE(J.allFinite());
  for (Eigen::Index j = 0; j < J.cols(); ++j) {
    const FreeParameter& parameter = knee.parameters[static_cast<std::size_t>(j)];
    const double step = h * step_of(parameter);
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(y.size()), there;
    for (const auto& [steps, weight] :
         {std::pair{1, 8.0}, std::pair{-1, -8.0}, std::pair{2, -1.0}, std::pair{-2, 1.0}}) {
      Eigen::VectorXd moved = theta;
      moved[j] += steps * step;
      ASSERT_TRUE(predictions.evaluate(moved, there, nullptr)) << predictions.failure();
      expected += weight * there / (12 * step);
    }
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      const int group = group_of(knee.table.rows[static_cast<std::size_t>(i)]);
      double greatest = 0, value = 1e-3;
      for (Eigen::Index k = 0; k < y.size(); ++k) {
        if (group_of(knee.table.rows[static_cast<std::size_t>(k)]) != group) continue;
        greatest = std::max(greatest, std::abs(expected[k]));
        value = std::max(value, std::abs(y[k]));
      }
      constexpr double kRoundOff = 1e-11;  // of what Newton leaves
      EXPECT_NEAR(J(i, j), expected[i], 1e-6 * greatest + kRoundOff * value / step)
          << parameter.name << ", row " << i;
    }
  }
}

inline Eigen::VectorXd some_theta(const Measured& knee, double part, unsigned seed = 3) {
  Random random(seed);
  Eigen::VectorXd theta(static_cast<Eigen::Index>(knee.parameters.size()));
  for (Eigen::Index j = 0; j < theta.size(); ++j)
    theta[j] = part * knee.parameters[static_cast<std::size_t>(j)].prior_sd * random.between(-1, 1);
  return theta;
}

inline void free_all_of_ligaments(Measured& knee, const std::vector<std::size_t>& ligaments) {
  for (const std::size_t i : ligaments) {
    const std::string name = knee.scene.ligaments[i].name;
    knee.parameters.push_back(
        free_number(name + ".reference_strain", {ParameterKind::kReferenceStrain, i}, 0.03));
    knee.parameters.push_back(
        free_number(name + ".stiffness", {ParameterKind::kStiffness, i}, 0.3, true));
    knee.parameters.push_back(
        free_number(name + ".transition_strain", {ParameterKind::kTransitionStrain, i}, 0.01));
    for (const OfBody body : {OfBody::kFixed, OfBody::kMoving}) {
      // In a tangent plane that is none of the axes, and along its normal.
      const Eigen::Matrix3d axes = exp_rotation({0.4, -0.7, 0.2});
      for (int k = 0; k < 3; ++k) {
        FreeParameter parameter = free_number(name + ".insertion", {}, k < 2 ? 2 : 0.5);
        parameter.moves.clear();
        for (const int c : {0, 1, 2})
          parameter.moves.push_back(
              {{ParameterKind::kInsertion, i, body, c, Held::kReferenceStrain}, axes(c, k)});
        knee.parameters.push_back(parameter);
      }
    }
  }
}

inline void free_frames(Measured& knee) {
  for (const auto kind : {FreeParameter::Kind::kFemurFrame, FreeParameter::Kind::kTibiaFrame})
    for (int component = 0; component < 6; ++component) {
      FreeParameter parameter;
      parameter.name = "frame " + std::to_string(component);
      parameter.kind = kind;
      parameter.component = component;
      parameter.prior_sd = component < 3 ? 2 : 2 * kDegree;
      knee.parameters.push_back(parameter);
    }
}

}  // namespace condyle::test
