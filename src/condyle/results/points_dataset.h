#pragma once

/// Points as a dataset: the last axis holds x, y and z.

#include <fmt/format.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <vector>

#include "condyle/results/hdf5_file.h"

namespace condyle {

[[nodiscard]] inline std::vector<double> coordinates(const std::vector<Eigen::Vector3d>& points) {
  std::vector<double> out;
  out.reserve(3 * points.size());
  for (const Eigen::Vector3d& point : points) out.insert(out.end(), point.begin(), point.end());
  return out;
}

/// None is infinite or not a number.
[[nodiscard]] inline bool are_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

/// Finite all of them; `shape` becomes that of the dataset.
[[nodiscard]] inline std::vector<Eigen::Vector3d> read_points(const Hdf5Group& group,
                                                              const char* name,
                                                              Shape& shape) {
  const Hdf5Array array = group.read(name);
  shape = array.shape;
  if (shape.empty() || shape.back() != 3)
    group.fail(fmt::format("dataset {} does not hold points", name));
  if (!are_finite(array.values))
    group.fail(fmt::format("dataset {} holds what is no number", name));
  std::vector<Eigen::Vector3d> points(array.values.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = Eigen::Map<const Eigen::Vector3d>(&array.values[3 * i]);
  return points;
}

}  // namespace condyle
