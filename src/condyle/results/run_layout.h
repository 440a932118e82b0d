#pragma once

/// Which dataset of a run file holds which number: one table each, used by writer and reader alike.

#include <array>

#include "condyle/elements/joint_table.h"
#include "condyle/equilibrium/pose_result.h"
#include "condyle/math/degree.h"
#include "condyle/scene/fitted_surface.h"

namespace condyle {

inline constexpr const char* kRunFormat = "condyle 1";

/// A number of T under its name; the file holds it divided by `unit`.
template <typename T>
struct Column {
  const char* name;
  const char* units;
  double T::*member;
  double unit = 1;
};

constexpr std::array<Column<JointCoordinates>, 6> joint_columns() {
  std::array<Column<JointCoordinates>, 6> columns{};
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const JointCoordinate& q = kJointCoordinates[i];
    columns[i] = {q.name, q.angle ? "deg" : "mm", q.member, q.angle ? kDegree : 1};
  }
  return columns;
}
inline constexpr std::array<Column<JointCoordinates>, 6> kJointColumns = joint_columns();

inline constexpr std::array<Column<LigamentResult>, 3> kLigamentColumns = {{
    {"length", "mm", &LigamentResult::length},
    {"strain", "1", &LigamentResult::strain},
    {"force", "N", &LigamentResult::force},
}};

/// Of /patches/SURFACE/fit; rms and maximum stand beside it.
inline constexpr std::array<Column<FitReport>, 11> kFitColumns = {{
    {"smoothing_length", "mm", &FitReport::smoothing_length},
    {"p95", "mm", &FitReport::p95},
    {"back_rms", "mm", &FitReport::back_rms},
    {"back_p95", "mm", &FitReport::back_p95},
    {"back_max", "mm", &FitReport::back_max},
    {"condition", "1", &FitReport::condition},
    {"area", "mm^2", &FitReport::area},
    {"core_rms", "mm", &FitReport::core_rms},
    {"core_max", "mm", &FitReport::core_max},
    {"normal_rms", "deg", &FitReport::normal_rms, kDegree},
    {"seconds", "s", &FitReport::seconds},
}};

/// Numbers of a contact point that lie side by side.
struct PointColumn {
  const char* name;
  const char* units;
  std::size_t width;  ///< 1: a number, else a vector
  double* (*data)(ContactPointResult& point);
};

inline constexpr std::array<PointColumn, 7> kPointColumns = {{
    {"force", "N", 1, [](ContactPointResult& point) { return &point.force; }},
    {"point_ground", "mm", 3, [](ContactPointResult& point) { return point.point_ground.data(); }},
    {"point_moving", "mm", 3, [](ContactPointResult& point) { return point.point_moving.data(); }},
    {"normal_ground", "1", 3, [](ContactPointResult& point) { return point.normal_ground.data(); }},
    {"gap", "mm", 1, [](ContactPointResult& point) { return &point.gap; }},
    {"relative_curvature", "1/mm", 2,
     [](ContactPointResult& point) { return point.relative_curvature.data(); }},
    {"edge_distance", "mm", 1, [](ContactPointResult& point) { return &point.edge_distance; }},
}};

}  // namespace condyle
