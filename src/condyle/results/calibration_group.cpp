#include "condyle/results/calibration_group.h"

#include <cmath>

#include "condyle/results/calibration_parts.h"
#include "condyle/results/record_columns.h"
#include "condyle/results/run_layout.h"

namespace condyle {
namespace {

// Agreement, starts, suggestions: plain records.

template <class Door>
void tell_agreement(const Door& door) {
  door("name", &Agreement::name);
  door("rows", &Agreement::rows);
  door("lost", &Agreement::lost);
  door("before", &Agreement::before);
  door("after", &Agreement::after);
  door("covered", &Agreement::covered);
  door("length_before", &Agreement::length_before, "mm");
  door("length_after", &Agreement::length_after, "mm");
  door("angle_before", &Agreement::angle_before, "deg");
  door("angle_after", &Agreement::angle_after, "deg");
}

template <class Door>
void tell_start(const Door& door) {
  door("cost", &CalibrationStart::cost);
  door("distance", &CalibrationStart::distance);
  door("converged", &CalibrationStart::converged);
  door("iterations", &CalibrationStart::iterations);
  door("message", &CalibrationStart::message);
}

template <class Door>
void tell_suggestion(const Door& door) {
  door("flexion", &SuggestedTest::flexion, "deg");
  door("load", &SuggestedTest::load);
  door("level", &SuggestedTest::level, "N, N mm, mm or rad");
  door("information", &SuggestedTest::information);
  door("shrinkage", &SuggestedTest::shrinkage);
  door("reason", &SuggestedTest::reason);
}

void write_agreements(const Hdf5Group& group, const CalibrationResult& result) {
  std::vector<Agreement> all = {result.fitted, result.unseen};
  all.insert(all.end(), result.tests.begin(), result.tests.end());
  for (Agreement& agreement : all) {
    agreement.angle_before /= kDegree;
    agreement.angle_after /= kDegree;
  }
  tell_agreement(RecordWriter<Agreement>(group, all));
}

void read_agreements(const Hdf5Group& group, CalibrationResult& result) {
  std::vector<Agreement> all(group.read_texts("name").size());
  if (all.size() < 2) group.fail("holds no agreement of fitted and unseen rows");
  tell_agreement(RecordReader<Agreement>(group, all));
  for (Agreement& agreement : all) {
    agreement.angle_before *= kDegree;
    agreement.angle_after *= kDegree;
  }
  result.fitted = all[0];
  result.unseen = all[1];
  result.tests.assign(all.begin() + 2, all.end());
}

void write_suggestions(const Hdf5Group& group, std::vector<SuggestedTest> tests) {
  for (SuggestedTest& test : tests) test.flexion /= kDegree;
  tell_suggestion(RecordWriter<SuggestedTest>(group, tests));
}

std::vector<SuggestedTest> read_suggestions(const Hdf5Group& group) {
  std::vector<SuggestedTest> tests(group.read_texts("reason").size());
  tell_suggestion(RecordReader<SuggestedTest>(group, tests));
  for (SuggestedTest& test : tests) test.flexion *= kDegree;
  return tests;
}

// Bands and profiles.

void write_bands(const Hdf5Group& group, const CalibrationResult& result) {
  std::vector<double> flexions;
  for (const double flexion : result.band_flexions) flexions.push_back(flexion / kDegree);
  group.write("flexion", flexions, {flexions.size()}, "deg");
  std::vector<std::string> quantities, units;
  std::vector<std::vector<double>> before, before_sd, after, after_sd;
  for (const Band& band : result.bands) {
    quantities.push_back(band.quantity);
    units.push_back(band.units);
    before.push_back(band.before);
    before_sd.push_back(band.before_sd);
    after.push_back(band.after);
    after_sd.push_back(band.after_sd);
  }
  group.write("quantity", quantities);
  group.write("units", units);
  write_lists(group, "before", before);
  write_lists(group, "before_sd", before_sd);
  write_lists(group, "after", after);
  write_lists(group, "after_sd", after_sd);
}

void read_bands(const Hdf5Group& group, CalibrationResult& result) {
  for (const double flexion : group.read("flexion").values)
    result.band_flexions.push_back(flexion * kDegree);
  const std::vector<std::string> quantities = group.read_texts("quantity"),
                                 units = group.read_texts("units");
  const auto before = read_lists(group, "before"), before_sd = read_lists(group, "before_sd"),
             after = read_lists(group, "after"), after_sd = read_lists(group, "after_sd");
  const auto fits = [&](const std::vector<std::vector<double>>& lists) {
    return lists.size() == quantities.size() &&
           (lists.empty() || lists.front().size() == result.band_flexions.size());
  };
  if (units.size() != quantities.size() || !fits(before) || !fits(before_sd) || !fits(after) ||
      !fits(after_sd))
    group.fail("has not a number for each quantity and flexion");
  for (std::size_t k = 0; k < quantities.size(); ++k)
    result.bands.push_back(
        {quantities[k], units[k], before[k], before_sd[k], after[k], after_sd[k]});
}

void write_profiles(const Hdf5Group& group, const CalibrationResult& result) {
  std::vector<int> parameters;
  std::vector<std::vector<double>> theta, chi_square;
  for (const Profile& profile : result.profiles) {
    parameters.push_back(static_cast<int>(profile.parameter));
    theta.push_back(profile.theta);
    const double unit = inside(told(result.parameters.at(profile.parameter).units));
    for (double& value : theta.back()) value /= unit;
    chi_square.push_back(profile.chi_square);
  }
  group.write("parameter", parameters, {parameters.size()}, "1");
  write_lists(group, "theta", theta);
  write_lists(group, "chi_square", chi_square);
}

void read_profiles(const Hdf5Group& group, CalibrationResult& result) {
  const auto theta = read_lists(group, "theta"), chi_square = read_lists(group, "chi_square");
  const std::vector<int> parameters = group.read_integers("parameter", {theta.size()});
  if (chi_square.size() != theta.size()) group.fail("has not a chi_square for each theta");
  for (std::size_t k = 0; k < theta.size(); ++k) {
    Profile profile;
    profile.parameter = static_cast<std::size_t>(parameters[k]);
    if (parameters[k] < 0 || profile.parameter >= result.parameters.size() ||
        chi_square[k].size() != theta[k].size())
      group.fail("holds a profile of no parameter, or without a chi_square for each theta");
    const double unit = inside(told(result.parameters[profile.parameter].units));
    for (std::size_t i = 0; i < theta[k].size() && !std::isnan(theta[k][i]); ++i) {
      profile.theta.push_back(theta[k][i] * unit);
      profile.chi_square.push_back(chi_square[k][i]);
    }
    result.profiles.push_back(profile);
  }
}

// Numbers that stand alone.

struct Figures {
  double cost, chi_square, reduced_chi_square, reduced_chi_square_limit, effective, cold_difference,
      seconds, fit_seconds, least_squares_seconds, poses, failed_poses;
  int iterations, refused, determined, lost_samples;
  bool converged, fit_stopped, stopped;
  std::string message;
};

template <class Door>
void tell_figures(const Door& door) {
  door("cost", &Figures::cost);
  door("chi_square", &Figures::chi_square);
  door("reduced_chi_square", &Figures::reduced_chi_square);
  door("reduced_chi_square_limit", &Figures::reduced_chi_square_limit);
  door("effective", &Figures::effective);
  door("determined", &Figures::determined);
  door("cold_difference", &Figures::cold_difference);
  door("iterations", &Figures::iterations);
  door("refused", &Figures::refused);
  door("converged", &Figures::converged);
  door("fit_stopped", &Figures::fit_stopped);
  door("stopped", &Figures::stopped);
  door("message", &Figures::message);
  door("lost_samples", &Figures::lost_samples);
  door("poses", &Figures::poses);
  door("failed_poses", &Figures::failed_poses);
  door("seconds", &Figures::seconds, "s");
  door("fit_seconds", &Figures::fit_seconds, "s");
  door("best_start_seconds", &Figures::least_squares_seconds, "s");
}

void write_figures(const Hdf5Group& group, const CalibrationResult& r) {
  const std::vector<Figures> figures = {
      {r.fit.cost, r.fit.chi_square, r.reduced_chi_square, r.reduced_chi_square_limit,
       r.known.effective, r.cold_difference, r.seconds, r.fit_seconds, r.fit.seconds,
       static_cast<double>(r.poses), static_cast<double>(r.failed_poses), r.fit.iterations,
       r.fit.refused, r.known.determined, r.lost_samples, r.fit.converged, r.fit.stopped, r.stopped,
       r.fit.message}};
  tell_figures(RecordWriter<Figures>(group, figures));
}

void read_figures(const Hdf5Group& group, CalibrationResult& r) {
  std::vector<Figures> figures(1);
  tell_figures(RecordReader<Figures>(group, figures));
  const Figures& f = figures.front();
  r.fit.cost = f.cost;
  r.fit.chi_square = f.chi_square;
  r.fit.iterations = f.iterations;
  r.fit.refused = f.refused;
  r.fit.converged = f.converged;
  r.fit.stopped = f.fit_stopped;
  r.fit.message = f.message;
  r.fit.seconds = f.least_squares_seconds;
  r.reduced_chi_square = f.reduced_chi_square;
  r.reduced_chi_square_limit = f.reduced_chi_square_limit;
  r.known.effective = f.effective;
  r.known.determined = f.determined;
  r.cold_difference = f.cold_difference;
  r.lost_samples = f.lost_samples;
  r.poses = std::lround(f.poses);
  r.failed_poses = std::lround(f.failed_poses);
  r.seconds = f.seconds;
  r.fit_seconds = f.fit_seconds;
  r.stopped = f.stopped;
}

// What is known.

/// Empty matrices where a fit was stopped before they were known.
void write_known(const Hdf5Group& group, const CalibrationResult& result) {
  const Eigen::VectorXd units = told_units(result.parameters);
  Eigen::MatrixXd covariance = result.known.covariance;
  if (covariance.rows() == units.size())
    covariance = units.cwiseInverse().asDiagonal() * covariance * units.cwiseInverse().asDiagonal();
  write_matrix(group, "covariance", covariance, "products of the units of parameters");
  write_vector(group, "singular_values", result.known.singular_values);
  write_matrix(group, "directions", result.known.directions);
}

void read_known(const Hdf5Group& group, CalibrationResult& result) {
  const Eigen::VectorXd units = told_units(result.parameters);
  Identifiability& known = result.known;
  const auto is_empty_or = [](const Eigen::MatrixXd& matrix, Eigen::Index rows,
                              Eigen::Index columns) {
    return matrix.size() == 0 || (matrix.rows() == rows && matrix.cols() == columns);
  };
  known.covariance = read_matrix(group, "covariance");
  known.singular_values = read_vector(group, "singular_values");
  known.directions = read_matrix(group, "directions");
  if (!is_empty_or(known.covariance, units.size(), units.size()))
    group.fail("covariance has not a row and a column for each parameter");
  if (!is_empty_or(known.directions, units.size(), known.singular_values.size()) ||
      (known.directions.size() == 0 && known.singular_values.size() > 0))
    group.fail("directions has not a row for each parameter and a column for each singular value");
  if (known.covariance.size() > 0)
    known.covariance = units.asDiagonal() * known.covariance * units.asDiagonal();
}

void write_samples(const Hdf5Group& posterior, const CalibrationResult& result) {
  std::vector<std::string> names, units;
  for (const FreeParameter& parameter : result.parameters) {
    names.push_back(parameter.name);
    units.push_back(told(parameter.units));
  }
  posterior.write("parameter", names);
  posterior.write("units", units);
  const Eigen::VectorXd per_unit = told_units(result.parameters).cwiseInverse();
  write_matrix(posterior, "samples", result.samples * per_unit.asDiagonal(), "as units");
}

/// Predictions of the fitted rows at the fit are those of the table's rows.
Eigen::VectorXd fitted_predictions(const CalibrationResult& result) {
  std::vector<double> y;
  for (std::size_t i = 0; i < result.rows.size(); ++i)
    if (result.table.rows[i].use == MeasuredUse::kFit) y.push_back(result.rows[i].after);
  return Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
}

}  // namespace

void write_calibration(const Hdf5Group& root, const Scene& scene, const CalibrationResult& result) {
  const Hdf5Group group = root.create("calibrate");
  group.write_attribute("table", result.table.file.string());
  group.write_attribute("specimen", result.table.specimen);
  write_figures(group.create("figures"), result);
  write_parameters(group.create("parameters"), result);
  write_known(group, result);
  write_matrix(group, "jacobian", result.fit.J, "mm, rad, N, N mm by mm, rad, 1");
  write_rows(group.create("rows"), scene, result);
  write_agreements(group.create("agreements"), result);
  tell_start(RecordWriter<CalibrationStart>(group.create("starts"), result.starts));
  group.write("silent", result.silent);
  write_bands(group.create("bands"), result);
  write_profiles(group.create("profiles"), result);
  write_suggestions(group.create("suggested"), result.suggested);
  if (result.samples.rows() > 0) write_samples(root.create("posterior"), result);
}

CalibrationResult read_calibration(const Hdf5Group& root, const Scene& scene) {
  const Hdf5Group group = root.open("calibrate");
  CalibrationResult result;
  result.table.file = group.read_attribute("table");
  result.table.specimen = group.read_attribute("specimen");
  read_figures(group.open("figures"), result);
  read_parameters(group.open("parameters"), result);
  read_known(group, result);
  read_rows(group.open("rows"), scene, result);
  result.fit.J = read_matrix(group, "jacobian");
  result.fit.y = fitted_predictions(result);
  read_agreements(group.open("agreements"), result);
  const Hdf5Group starts = group.open("starts");
  result.starts.resize(starts.read_texts("message").size());
  tell_start(RecordReader<CalibrationStart>(starts, result.starts));
  result.silent = group.read_texts("silent");
  read_bands(group.open("bands"), result);
  read_profiles(group.open("profiles"), result);
  result.suggested = read_suggestions(group.open("suggested"));
  if (root.has("posterior")) {
    const Hdf5Group posterior = root.open("posterior");
    const Eigen::MatrixXd samples = read_matrix(posterior, "samples");
    if (static_cast<std::size_t>(samples.cols()) != result.parameters.size())
      posterior.fail("samples has not a column for each parameter");
    result.samples = samples * told_units(result.parameters).asDiagonal();
  }
  return result;
}

}  // namespace condyle
