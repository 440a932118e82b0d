#pragma once

/// A calibration that nobody computed: the knee of Wismans' type with a drawer and a varus test, five
/// numbers free, predictions linear in them, so that covariance and singular values belong to the rows.

#include <Eigen/Core>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "condyle/calibration/calibration.h"
#include "condyle/math/decompositions.h"
#include "condyle/math/degree.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle::test {

inline CalibrationDescription made_up_description() {
  CalibrationDescription asked;
  asked.measurements = "knee.csv";
  asked.specimen = "k1";
  asked.flexion = 0;
  asked.moment_to_nmm = 1000;
  asked.relative = {"ap30"};
  asked.curve_sd = {0.5, kDegree};
  asked.loads = {{"anterior", false, 0}, {"varus", false, 1}};
  asked.parameters.resize(3);
  asked.parameters[0].of = {0, 3};
  asked.parameters[0].prior_sd = 0.03;
  asked.parameters[1].what = ParameterKind::kStiffness;
  asked.parameters[1].of = {7};
  asked.parameters[1].prior_sd = 0.3;
  asked.parameters[2].what = ParameterKind::kInsertion;
  asked.parameters[2].of = {4};
  asked.parameters[2].body = 0;
  asked.parameters[2].prior_sd = 2;
  return asked;
}

/// data/wismans-type/drawer.toml with a varus moment; `calibration` says what is free.
inline Scene made_up_calibration_scene() {
  const std::filesystem::path file =
      std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/wismans-type/drawer.toml";
  std::string text = read_scene(file).text;
  text.insert(text.find("[sweep]"),
              "[[load]]\nname = \"varus\"\nbody = \"tibia\"\nkind = \"moment\"\n"
              "vector = [0, 1000, 0]\n\n");
  Scene scene = parse_scene(text, file);
  scene.calibration = made_up_description();
  return scene;
}

namespace made_up {

inline FreeParameter number(const std::string& name, ModelParameter of, double sd, double start) {
  FreeParameter parameter;
  parameter.name = name;
  parameter.units = "1";
  parameter.moves = {{of, 1.0}};
  parameter.prior_sd = sd;
  parameter.start = start;
  return parameter;
}

inline std::vector<FreeParameter> parameters() {
  std::vector<FreeParameter> all;
  all.push_back(number("aACL.reference_strain", {ParameterKind::kReferenceStrain, 0}, 0.03, 0.002));
  all.push_back(number("pPCL.reference_strain", {ParameterKind::kReferenceStrain, 3}, 0.03, 0.05));
  all.back().bounds = {-0.45, 0.15};
  all.push_back(number("LCL.stiffness", {ParameterKind::kStiffness, 7}, 0.3, 4346.44033));
  all.back().logarithmic = true;
  all.push_back(number("aMCL.insertion.femur.normal",
                       {ParameterKind::kInsertion, 4, OfBody::kFixed, 0}, 0.5, 0));
  all.back().units = "mm";
  FreeParameter offset;
  offset.name = "ap30.anterior_drawer offset";
  offset.units = "mm";
  offset.kind = FreeParameter::Kind::kCurveOffset;
  offset.test = "ap30";
  offset.coordinate = 4;
  offset.prior_sd = 0.5;
  all.push_back(offset);
  return all;
}

inline Measurement row(
    int line, const char* test, double flexion, int load, double level, std::size_t coordinate) {
  Measurement row;
  row.line = line;
  row.test = test;
  row.flexion = flexion * kDegree;
  row.load = load;
  row.level = level;
  row.index = coordinate;
  row.sd = coordinate < 3 ? 0.5 * kDegree : 0.5;
  return row;
}

/// Drawer at 30 deg, varus at 0 and, unseen, at 60 deg, a passive row, a force and a row without pose.
inline std::vector<Measurement> rows() {
  std::vector<Measurement> rows;
  for (const double level : {-100.0, -50.0, 50.0, 100.0})
    rows.push_back(row(2 + static_cast<int>(rows.size()), "ap30", 30, 0, level, 4));
  rows.push_back(row(6, "ap30", 30, 0, 100, 2));
  for (const double level : {-10000.0, 10000.0})
    rows.push_back(row(2 + static_cast<int>(rows.size()), "vv0", 0, 1, level, 1));
  rows.push_back(row(9, "passive", 45, -1, 0, 2));
  rows.push_back(row(10, "ap30", 30, 0, 100, 0));
  rows.back().kind = MeasuredKind::kLigamentForce;
  rows.back().sd = 5;
  for (const double level : {-10000.0, 10000.0}) {
    rows.push_back(row(2 + static_cast<int>(rows.size()), "vv60", 60, 1, level, 1));
    rows.back().use = MeasuredUse::kTest;
  }
  rows.push_back(row(13, "vv90", 90, 1, 12000, 1));
  rows.back().use = MeasuredUse::kTest;
  return rows;
}

/// ∂y/∂θ sd of the row, over the prior's: [-].
inline Eigen::MatrixXd scaled_rates() {
  Eigen::MatrixXd S(12, 5);
  for (int i = 0; i < S.rows(); ++i)
    S.row(i) << 6 * std::sin(1.0 + i), 0.2 * std::cos(2.0 * i), 1.5 * std::sin(0.7 * i),
        0.15 * std::cos(0.3 * i), i < 5 ? 1 : 0;
  return S;
}

inline void fill_rows(CalibrationResult& result, const Eigen::MatrixXd& S) {
  const Eigen::VectorXd moved = S * (result.fit.theta.array() / result.prior_sd.array()).matrix();
  const Eigen::MatrixXd whitened = result.prior_sd.cwiseInverse().asDiagonal() *
                                   result.known.covariance *
                                   result.prior_sd.cwiseInverse().asDiagonal();
  for (std::size_t i = 0; i < result.table.rows.size(); ++i) {
    const Eigen::VectorXd s = S.row(static_cast<Eigen::Index>(i));
    const double sd = result.table.rows[i].sd;
    CalibratedRow row;
    row.before = sd * (3 + static_cast<double>(i));
    row.after = row.before + sd * moved[static_cast<Eigen::Index>(i)];
    row.prior_sd = sd * s.norm();
    row.after_sd = sd * std::sqrt(s.dot(whitened * s));
    row.sd = 1.1 * sd;
    result.table.rows[i].value = row.after + (i % 2 ? -0.7 : 0.9) * sd;
    if (i + 1 == result.table.rows.size()) row.before = row.after = row.after_sd = std::nan("");
    result.rows.push_back(row);
  }
}

inline Identifiability known(const Eigen::MatrixXd& S, const Eigen::VectorXd& prior_sd) {
  const SingularValues of_S = singular_values(S);
  Identifiability known;
  known.singular_values = of_S.values;
  known.directions = of_S.V.leftCols(of_S.values.size());
  known.determined = static_cast<int>((known.singular_values.array() > 1).count());
  const Eigen::ArrayXd squares = known.singular_values.array().square();
  known.effective = (squares / (1 + squares)).sum();
  known.covariance =
      known.directions * (1 / (1 + squares)).matrix().asDiagonal() * known.directions.transpose();
  known.covariance = prior_sd.asDiagonal() * known.covariance * prior_sd.asDiagonal();
  known.sd = known.covariance.diagonal().cwiseSqrt();
  return known;
}

inline void fill_studies(CalibrationResult& result) {
  for (int k = 0; k <= 9; ++k) result.band_flexions.push_back(10 * k * kDegree);
  for (const auto& [quantity, units] :
       {std::pair{"anterior_drawer", "mm"}, {"internal_rotation", "deg"}, {"aACL.force", "N"}}) {
    Band band{quantity, units, {}, {}, {}, {}};
    for (const double angle : result.band_flexions) {
      band.before.push_back(4 * std::sin(angle));
      band.before_sd.push_back(1 + angle);
      band.after.push_back(5 * std::sin(angle));
      band.after_sd.push_back(0.3 + 0.2 * angle);
    }
    band.after.back() = band.after_sd.back() = std::nan("");
    result.bands.push_back(band);
  }
  for (std::size_t j = 0; j < result.parameters.size(); ++j) {
    Profile profile;
    profile.parameter = j;
    for (int k = -9; k <= 9; ++k) {
      const auto of = static_cast<Eigen::Index>(j);
      profile.theta.push_back(result.fit.theta[of] + result.known.sd[of] * k / 3.0);
      profile.chi_square.push_back(k * k / 9.0 * (1 + 0.02 * k));
    }
    result.profiles.push_back(profile);
  }
  result.suggested = {{60 * kDegree, 1, 10000, 0.8, 0.71, ""},
                      {90 * kDegree, 0, -100, 0.3, 0.88, ""},
                      {90 * kDegree, 1, 10000, 0, 1, "no pose: the descent found no rest"}};
}

}  // namespace made_up

inline CalibrationResult made_up_calibration() {
  CalibrationResult result;
  result.table = {"knee.csv", "k1", made_up::rows()};
  result.parameters = made_up::parameters();
  const auto n = static_cast<Eigen::Index>(result.parameters.size());
  result.prior_sd.resize(n);
  for (Eigen::Index j = 0; j < n; ++j) result.prior_sd[j] = result.parameters[j].prior_sd;
  Eigen::MatrixXd S = made_up::scaled_rates();
  result.known = made_up::known(S.topRows(9), result.prior_sd);
  result.at_bound.assign(result.parameters.size(), false);
  result.fit.theta.resize(n);
  result.fit.theta << 0.0213, -0.004, std::log(1.25), 0.11, -0.2;
  made_up::fill_rows(result, S);

  result.fit.y.resize(9);
  for (int i = 0; i < 9; ++i) result.fit.y[i] = result.rows[i].after;
  Eigen::VectorXd sd(9);
  for (int i = 0; i < 9; ++i) sd[i] = result.table.rows[i].sd;
  result.fit.J = sd.asDiagonal() * S.topRows(9) * result.prior_sd.cwiseInverse().asDiagonal();
  result.fit.cost = 6.25;
  result.fit.chi_square = 8.5;
  result.fit.iterations = 7;
  result.fit.refused = 1;
  result.fit.converged = true;
  result.fit.message = "relative change of the cost below 1e-12";
  result.fit.seconds = 0.004;
  result.starts = {{6.25, 0, true, 7, "the scene's own"},
                   {6.25, 1e-9, true, 11, ""},
                   {7.5, 1.4, true, 15, ""},
                   {9.0, 3.1, false, 100, "iterations used up"}};
  result.fitted = {"fitted", 9, 0, 6.1, 0.97, 0.944, 0.31, 0.006, 3.2, 0.05};
  result.unseen = {"unseen", 3, 1, 4.4, 1.2, 0.9, std::nan(""), 0.007, std::nan(""), 0.04};
  result.tests = {result.fitted, result.unseen};
  result.tests[0].name = "ap30, 30 deg";
  result.tests[1].name = "vv60, 60 deg";
  result.reduced_chi_square = 1.4;
  result.reduced_chi_square_limit = 2.1;
  result.samples.resize(40, n);
  for (int i = 0; i < 40; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      result.samples(i, j) = result.fit.theta[j] +
                             result.known.sd[j] * std::sin(7.0 * i + 3.0 * static_cast<double>(j));
  result.lost_samples = 1;
  result.sample_sd = result.known.sd;
  result.sample_sd[1] *= 1.25;
  result.silent = {"oMCL", "APL"};
  result.cold_difference = 2e-9;
  made_up::fill_studies(result);
  result.seconds = 0.4;
  result.fit_seconds = 0.02;
  result.poses = 1234;
  result.failed_poses = 5;
  return result;
}

}  // namespace condyle::test
