#pragma once

/// Parts of calibration_group.cpp: vectors and matrices as datasets, units at the border, and the two
/// long tables, of parameters and of rows.

#include <Eigen/Core>

#include <string>
#include <vector>

#include "condyle/calibration/calibration.h"
#include "condyle/math/no_number.h"
#include "condyle/results/hdf5_file.h"

namespace condyle {

/// How much of the unit used inside one of `units` is: of "deg" π/180, else 1.
[[nodiscard]] double inside(const std::string& units);
/// The unit that a number is told in: "deg" for "rad".
[[nodiscard]] std::string told(const std::string& units);
/// `inside` of each θ as it is told.
[[nodiscard]] Eigen::VectorXd told_units(const std::vector<FreeParameter>& parameters);

void write_vector(const Hdf5Group& group, const char* name, const Eigen::VectorXd& v);
[[nodiscard]] Eigen::VectorXd read_vector(const Hdf5Group& group, const char* name);
void write_matrix(const Hdf5Group& group,
                  const char* name,
                  const Eigen::MatrixXd& m,
                  const char* units = "1");
[[nodiscard]] Eigen::MatrixXd read_matrix(const Hdf5Group& group, const char* name);
/// Lists as rows of a matrix; shorter ones end with NaN.
void write_lists(const Hdf5Group& group,
                 const char* name,
                 const std::vector<std::vector<double>>& lists);
[[nodiscard]] std::vector<std::vector<double>> read_lists(const Hdf5Group& group, const char* name);

void write_parameters(const Hdf5Group& group, const CalibrationResult& result);
/// Fills parameters, prior_sd, fit.theta, known.sd, sample_sd and at_bound.
void read_parameters(const Hdf5Group& group, CalibrationResult& result);

void write_rows(const Hdf5Group& group, const Scene& scene, const CalibrationResult& result);
/// Fills table.rows and rows.
void read_rows(const Hdf5Group& group, const Scene& scene, CalibrationResult& result);

}  // namespace condyle
