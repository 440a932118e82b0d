/// A calibration on disk: what is written is read back.

#include "condyle/results/calibration_group.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "condyle/input_error.h"
#include "condyle/results/run_file.h"
#include "support/made_up_calibration.h"

namespace condyle::test {
namespace {

namespace fs = std::filesystem;

/// Through degrees and back a number may change in its last bit.
void expect_close(double a, double b) {
  if (std::isnan(a)) {
    EXPECT_TRUE(std::isnan(b));
  } else {
    EXPECT_NEAR(a, b, 4e-16 * std::abs(a));
  }
}

template <class List>
void expect_list(const List& a, const List& b) {
  ASSERT_EQ(a.size(), b.size());
  for (decltype(a.size()) i = 0; i < a.size(); ++i) expect_close(a[i], b[i]);
}

void expect_matrix(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.cols(), b.cols());
  for (Eigen::Index j = 0; j < a.cols(); ++j)
    for (Eigen::Index i = 0; i < a.rows(); ++i) expect_close(a(i, j), b(i, j));
}

void expect_same(const Agreement& a, const Agreement& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.rows, b.rows);
  EXPECT_EQ(a.lost, b.lost);
  expect_list(std::vector{a.before, a.after, a.covered, a.length_before, a.length_after,
                          a.angle_before, a.angle_after},
              std::vector{b.before, b.after, b.covered, b.length_before, b.length_after,
                          b.angle_before, b.angle_after});
}

void expect_same(const Measurement& a, const Measurement& b) {
  EXPECT_EQ(a.line, b.line);
  EXPECT_EQ(a.test, b.test);
  EXPECT_EQ(a.load, b.load);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.index, b.index);
  EXPECT_EQ(a.use, b.use);
  EXPECT_EQ(a.laxity, b.laxity);
  expect_list(std::vector{a.flexion, a.level, a.value, a.sd},
              std::vector{b.flexion, b.level, b.value, b.sd});
}

void expect_same(const FreeParameter& a, const FreeParameter& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.units, b.units);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.moves, b.moves);
  EXPECT_EQ(a.logarithmic, b.logarithmic);
  EXPECT_EQ(a.component, b.component);
  EXPECT_EQ(a.test, b.test);
  EXPECT_EQ(a.coordinate, b.coordinate);
  expect_list(std::vector{a.prior_sd, a.bounds[0], a.bounds[1], a.start},
              std::vector{b.prior_sd, b.bounds[0], b.bounds[1], b.start});
}

void expect_same_fit(const CalibrationResult& a, const CalibrationResult& b) {
  expect_list(a.fit.theta, b.fit.theta);
  expect_list(a.fit.y, b.fit.y);
  expect_matrix(a.fit.J, b.fit.J);
  EXPECT_EQ(a.fit.cost, b.fit.cost);
  EXPECT_EQ(a.fit.chi_square, b.fit.chi_square);
  EXPECT_EQ(a.fit.iterations, b.fit.iterations);
  EXPECT_EQ(a.fit.refused, b.fit.refused);
  EXPECT_EQ(a.fit.converged, b.fit.converged);
  EXPECT_EQ(a.fit.message, b.fit.message);
  EXPECT_EQ(a.fit.seconds, b.fit.seconds);
  expect_matrix(a.known.covariance, b.known.covariance);
  expect_list(a.known.singular_values, b.known.singular_values);
  expect_matrix(a.known.directions, b.known.directions);
  expect_list(a.known.sd, b.known.sd);
  EXPECT_EQ(a.known.determined, b.known.determined);
  EXPECT_EQ(a.known.effective, b.known.effective);
}

void expect_same_studies(const CalibrationResult& a, const CalibrationResult& b) {
  expect_list(a.band_flexions, b.band_flexions);
  ASSERT_EQ(a.bands.size(), b.bands.size());
  for (std::size_t k = 0; k < a.bands.size(); ++k) {
    EXPECT_EQ(a.bands[k].quantity, b.bands[k].quantity);
    EXPECT_EQ(a.bands[k].units, b.bands[k].units);
    expect_list(a.bands[k].before, b.bands[k].before);
    expect_list(a.bands[k].before_sd, b.bands[k].before_sd);
    expect_list(a.bands[k].after, b.bands[k].after);
    expect_list(a.bands[k].after_sd, b.bands[k].after_sd);
  }
  ASSERT_EQ(a.profiles.size(), b.profiles.size());
  for (std::size_t k = 0; k < a.profiles.size(); ++k) {
    EXPECT_EQ(a.profiles[k].parameter, b.profiles[k].parameter);
    expect_list(a.profiles[k].theta, b.profiles[k].theta);
    expect_list(a.profiles[k].chi_square, b.profiles[k].chi_square);
  }
  ASSERT_EQ(a.suggested.size(), b.suggested.size());
  for (std::size_t k = 0; k < a.suggested.size(); ++k) {
    expect_close(a.suggested[k].flexion, b.suggested[k].flexion);
    EXPECT_EQ(a.suggested[k].load, b.suggested[k].load);
    EXPECT_EQ(a.suggested[k].level, b.suggested[k].level);
    EXPECT_EQ(a.suggested[k].information, b.suggested[k].information);
    EXPECT_EQ(a.suggested[k].shrinkage, b.suggested[k].shrinkage);
    EXPECT_EQ(a.suggested[k].reason, b.suggested[k].reason);
  }
}

void expect_same(const CalibrationResult& a, const CalibrationResult& b) {
  EXPECT_EQ(a.table.file, b.table.file);
  EXPECT_EQ(a.table.specimen, b.table.specimen);
  ASSERT_EQ(a.table.rows.size(), b.table.rows.size());
  for (std::size_t i = 0; i < a.table.rows.size(); ++i) {
    expect_same(a.table.rows[i], b.table.rows[i]);
    const CalibratedRow &p = a.rows[i], &q = b.rows[i];
    expect_list(std::vector{p.before, p.after, p.prior_sd, p.after_sd, p.sd},
                std::vector{q.before, q.after, q.prior_sd, q.after_sd, q.sd});
  }
  ASSERT_EQ(a.parameters.size(), b.parameters.size());
  for (std::size_t j = 0; j < a.parameters.size(); ++j)
    expect_same(a.parameters[j], b.parameters[j]);
  EXPECT_EQ(a.at_bound, b.at_bound);
  expect_list(a.prior_sd, b.prior_sd);
  expect_list(a.sample_sd, b.sample_sd);
  expect_matrix(a.samples, b.samples);
  expect_same_fit(a, b);
  expect_same(a.fitted, b.fitted);
  expect_same(a.unseen, b.unseen);
  ASSERT_EQ(a.tests.size(), b.tests.size());
  for (std::size_t i = 0; i < a.tests.size(); ++i) expect_same(a.tests[i], b.tests[i]);
  ASSERT_EQ(a.starts.size(), b.starts.size());
  for (std::size_t i = 0; i < a.starts.size(); ++i) {
    EXPECT_EQ(a.starts[i].cost, b.starts[i].cost);
    EXPECT_EQ(a.starts[i].distance, b.starts[i].distance);
    EXPECT_EQ(a.starts[i].converged, b.starts[i].converged);
    EXPECT_EQ(a.starts[i].iterations, b.starts[i].iterations);
    EXPECT_EQ(a.starts[i].message, b.starts[i].message);
  }
  EXPECT_EQ(a.reduced_chi_square, b.reduced_chi_square);
  EXPECT_EQ(a.reduced_chi_square_limit, b.reduced_chi_square_limit);
  EXPECT_EQ(a.silent, b.silent);
  EXPECT_EQ(a.lost_samples, b.lost_samples);
  EXPECT_EQ(a.cold_difference, b.cold_difference);
  EXPECT_EQ(a.seconds, b.seconds);
  EXPECT_EQ(a.fit_seconds, b.fit_seconds);
  EXPECT_EQ(a.poses, b.poses);
  EXPECT_EQ(a.failed_poses, b.failed_poses);
  EXPECT_EQ(a.stopped, b.stopped);
  expect_same_studies(a, b);
}

class CalibrationGroup : public testing::Test {
 protected:
  void SetUp() override {
    path_ = fs::path(testing::TempDir()) / ("condyle_fit_" + std::to_string(::getpid()) + ".h5");
  }
  void TearDown() override { fs::remove(path_); }
  condyle::Run through_the_disk(const CalibrationResult& result) const {
    condyle::Run run;
    run.scene = made_up_calibration_scene();
    run.study = std::make_shared<const CalibrationResult>(result);
    write_run(path_, run);
    return read_run(path_);
  }

  fs::path path_;
};

TEST_F(CalibrationGroup, IsReadBackAsItWasWritten) {
  CalibrationResult result = made_up_calibration();
  result.table.rows[4].laxity = true;
  const condyle::Run back = through_the_disk(result);
  EXPECT_EQ(back.kind(), RunKind::kCalibration);
  EXPECT_TRUE(back.sweep.poses.empty());
  ASSERT_NE(back.calibration(), nullptr);
  expect_same(result, *back.calibration());
}

TEST_F(CalibrationGroup, OfAFitThatWasStoppedHoldsTheBestSoFar) {
  CalibrationResult result = made_up_calibration();
  result.stopped = result.fit.stopped = true;
  result.fit.converged = false;
  result.samples.resize(0, 0);
  result.sample_sd.resize(0);
  result.band_flexions.clear();
  result.bands.clear();
  result.profiles.clear();
  result.suggested.clear();
  const condyle::Run back = through_the_disk(result);
  ASSERT_NE(back.calibration(), nullptr);
  expect_same(result, *back.calibration());
}

TEST_F(CalibrationGroup, TurnsAreWrittenInDegrees) {
  CalibrationResult result = made_up_calibration();
  result.parameters.back().coordinate = 1;
  result.parameters.back().units = "rad";
  (void)through_the_disk(result);
  const Hdf5Reader reader(path_);
  const Hdf5Group group = reader.root().open("calibrate");
  const auto last = result.parameters.size() - 1;
  const Hdf5Group parameters = group.open("parameters");
  EXPECT_EQ(parameters.read_texts("units").at(last), "deg");
  const double theta = result.fit.theta[static_cast<Eigen::Index>(last)];
  expect_close(parameters.read("mean").values.at(last), theta * 180 / M_PI);
  expect_close(group.read("covariance").values.back(),
               std::pow(result.known.sd[static_cast<Eigen::Index>(last)] * 180 / M_PI, 2));
  EXPECT_EQ(group.open("rows").read_texts("units").at(5), "deg");
  expect_close(group.open("rows").read("flexion").values.at(0), 30);
}

TEST_F(CalibrationGroup, WhatNoProgramWritesIsRefused) {
  const auto expect_refused = [&](const CalibrationResult& result) {
    EXPECT_THROW((void)through_the_disk(result), InputError);
  };
  CalibrationResult result = made_up_calibration();
  result.parameters[0].kind = static_cast<FreeParameter::Kind>(9);
  expect_refused(result);
  result = made_up_calibration();
  result.parameters[0].moves[0].first.kind = static_cast<ParameterKind>(99);
  expect_refused(result);
  result = made_up_calibration();
  result.table.rows[0].use = static_cast<MeasuredUse>(7);
  expect_refused(result);
}

}  // namespace
}  // namespace condyle::test
