#include "condyle/results/calibration_parts.h"

#include <algorithm>
#include <cmath>

namespace condyle {

double inside(const std::string& units) { return units == "deg" ? M_PI / 180 : 1; }

std::string told(const std::string& units) { return units == "rad" ? "deg" : units; }

Eigen::VectorXd told_units(const std::vector<FreeParameter>& parameters) {
  Eigen::VectorXd units(static_cast<Eigen::Index>(parameters.size()));
  for (Eigen::Index j = 0; j < units.size(); ++j)
    units[j] = inside(told(parameters[static_cast<std::size_t>(j)].units));
  return units;
}

void write_vector(const Hdf5Group& group, const char* name, const Eigen::VectorXd& v) {
  group.write(name, std::vector<double>(v.begin(), v.end()), {static_cast<std::size_t>(v.size())},
              "1");
}

Eigen::VectorXd read_vector(const Hdf5Group& group, const char* name) {
  const std::vector<double> values = group.read(name).values;
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

namespace {
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
}  // namespace

void write_matrix(const Hdf5Group& group,
                  const char* name,
                  const Eigen::MatrixXd& m,
                  const char* units) {
  const RowMajor rows = m;
  group.write(name, std::vector<double>(rows.data(), rows.data() + rows.size()),
              {static_cast<std::size_t>(m.rows()), static_cast<std::size_t>(m.cols())}, units);
}

Eigen::MatrixXd read_matrix(const Hdf5Group& group, const char* name) {
  const Hdf5Array array = group.read(name);
  if (array.shape.size() != 2) group.fail(std::string("dataset ") + name + " is not a matrix");
  return Eigen::Map<const RowMajor>(array.values.data(), static_cast<Eigen::Index>(array.shape[0]),
                                    static_cast<Eigen::Index>(array.shape[1]));
}

void write_lists(const Hdf5Group& group,
                 const char* name,
                 const std::vector<std::vector<double>>& lists) {
  std::size_t width = 0;
  for (const std::vector<double>& list : lists) width = std::max(width, list.size());
  std::vector<double> values;
  for (const std::vector<double>& list : lists) {
    values.insert(values.end(), list.begin(), list.end());
    values.insert(values.end(), width - list.size(), kNoNumber);
  }
  group.write(name, values, {lists.size(), width}, "1");
}

std::vector<std::vector<double>> read_lists(const Hdf5Group& group, const char* name) {
  const Eigen::MatrixXd m = read_matrix(group, name);
  std::vector<std::vector<double>> rows;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    const Eigen::VectorXd row = m.row(i);
    rows.emplace_back(row.begin(), row.end());
  }
  return rows;
}

}  // namespace condyle
