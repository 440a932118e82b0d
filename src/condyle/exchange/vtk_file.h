#pragma once

/// VTK's XML files: poly data (.vtp) and a series over time (.pvd). Numbers are stored as 64-bit
/// binary in base64, so that every reader of VTK files takes them and none loses a digit.

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

/// Numbers at each point or cell: `width` 1, or 3 for vectors.
struct VtkArray {
  std::string name;
  std::size_t width = 1;
  std::vector<double> values;
};

/// Points with either triangles, or lines of two points, or (neither) each point a cell.
struct VtkPolyData {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 2>> lines;
  std::vector<VtkArray> point_data, cell_data;
  std::vector<std::string> cell_names;  ///< empty, or one for each cell
};
[[nodiscard]] std::string vtp_bytes(const VtkPolyData& data);

/// One file of a series.
struct VtkStep {
  double time = 0;
  int part = 0;
  std::string file;  ///< relative to the .pvd
};
[[nodiscard]] std::string pvd_bytes(const std::vector<VtkStep>& steps);

}  // namespace condyle
