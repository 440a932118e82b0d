#include "condyle/calibration/suggest_tests.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "condyle/calibration/predicted_table.h"
#include "condyle/elements/joint_table.h"

namespace condyle {
namespace {

constexpr double kFlexions[] = {0, 15, 30, 60, 90};  // [deg]
constexpr std::size_t kFlexionCoordinate = 0;

/// One that can be made, and where its rows stand.
struct Candidate {
  SuggestedTest test;
  std::vector<Eigen::Index> rows;
};

template <class Of>
std::optional<double> median_sd(const MeasurementTable& table, const Of& is_of) {
  std::vector<double> sds;
  for (const Measurement& row : table.rows)
    if (is_of(row)) sds.push_back(row.sd);
  if (sds.empty()) return {};
  const auto middle = sds.begin() + static_cast<std::ptrdiff_t>(sds.size() / 2);
  std::nth_element(sds.begin(), middle, sds.end());
  return *middle;
}

/// As of the rows of that coordinate, else of all angles or of all lengths.
std::optional<double> coordinate_sd(const MeasurementTable& table, std::size_t coordinate) {
  const auto own = median_sd(table, [&](const Measurement& row) {
    return row.kind == MeasuredKind::kJointCoordinate && row.index == coordinate;
  });
  if (own) return own;
  return median_sd(table, [&](const Measurement& row) {
    return row.kind == MeasuredKind::kJointCoordinate &&
           kJointCoordinates[row.index].angle == kJointCoordinates[coordinate].angle;
  });
}

/// What one measures in each candidate: rows with their sd, flexion and load to be set.
std::vector<Measurement> measured_in(const MeasurementTable& table, const Scene& scene, int load) {
  const CalibrationDescription& asked = *scene.calibration;
  const ConditionDescription* held = held_condition(load, scene);
  std::vector<Measurement> rows;
  for (std::size_t i = 0; i < kJointCoordinates.size(); ++i) {
    if (held != nullptr && static_cast<std::size_t>(held->kind) == i) continue;
    const std::optional<double> sd = coordinate_sd(table, i);
    if (i == kFlexionCoordinate || !sd) continue;
    rows.push_back(predicted_row(0, MeasuredKind::kJointCoordinate, i));
    const double zero = asked.curve_sd ? (*asked.curve_sd)[kJointCoordinates[i].angle ? 1 : 0] : 0;
    rows.back().sd = std::hypot(*sd, zero);
  }
  const auto reaction = median_sd(table, [&](const Measurement& row) {
    return row.kind == MeasuredKind::kReaction && row.load == load;
  });
  if (reaction) {
    rows.push_back(predicted_row(0, MeasuredKind::kReaction, 0));
    rows.back().sd = *reaction;
  }
  return rows;
}

/// Largest level of a load in the table; 0: it is not there.
double largest_level(const MeasurementTable& table, int load) {
  double level = 0;
  for (const Measurement& row : table.rows)
    if (row.load == load) level = std::max(level, std::abs(row.level));
  return level;
}

void add_candidate(const SuggestedTest& test,
                   const std::vector<Measurement>& measured,
                   MeasurementTable& table,
                   std::vector<Candidate>& candidates) {
  candidates.push_back({test, {}});
  for (Measurement row : measured) {
    row.flexion = test.flexion;
    row.load = test.load;
    row.level = test.level;
    candidates.back().rows.push_back(static_cast<Eigen::Index>(table.rows.size()));
    table.rows.push_back(row);
  }
}

std::vector<Candidate> candidates_of(const Scene& scene,
                                     const MeasurementTable& measured,
                                     MeasurementTable& table) {
  std::vector<Candidate> candidates;
  const CalibrationDescription& asked = *scene.calibration;
  for (const double degrees : kFlexions) {
    const double flexion = degrees * M_PI / 180;
    add_candidate({flexion, -1, 0, 0, 0, {}}, measured_in(measured, scene, -1), table, candidates);
    for (int load = 0; load < static_cast<int>(asked.loads.size()); ++load) {
      const double level = largest_level(measured, load);
      if (level == 0) continue;
      for (const double sign : {1., -1.})
        add_candidate({flexion, load, sign * level, 0, 0, {}}, measured_in(measured, scene, load),
                      table, candidates);
    }
  }
  return candidates;
}

/// Mean of sd after over before, of the parameters of the knee that the data left open.
double shrinkage_of(const CalibrationResult& at, const Eigen::MatrixXd& after) {
  double sum = 0;
  int count = 0;
  for (std::size_t j = 0; j < at.parameters.size(); ++j) {
    const auto k = static_cast<Eigen::Index>(j);
    if (at.parameters[j].nuisance() || !(at.known.sd[k] > 0)) continue;
    sum += std::sqrt(std::max(0., after(k, k))) / at.known.sd[k];
    ++count;
  }
  return count > 0 ? sum / count : 1;
}

void rate(const CalibrationResult& at,
          const PredictedTable& predicted,
          const MeasurementTable& table,
          Candidate& candidate) {
  const Eigen::VectorXd y = predicted.after.y(candidate.rows);
  if (y.size() == 0 || !y.allFinite()) {
    candidate.test.shrinkage = 1;
    candidate.test.reason = y.size() == 0 ? "no joint coordinate is measured" : "no pose";
    return;
  }
  Eigen::VectorXd weight(y.size());
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    const Eigen::Index row = candidate.rows[static_cast<std::size_t>(i)];
    const double sd = table.rows[static_cast<std::size_t>(row)].sd;
    weight[i] = 1 / std::sqrt(sd * sd + predicted.input_variance[row]);
  }
  const Information told =
      information_of(predicted.after.J(candidate.rows, Eigen::all), weight, at.known.covariance);
  candidate.test.information = told.nats;
  candidate.test.shrinkage = shrinkage_of(at, told.covariance);
}

}  // namespace

std::vector<SuggestedTest> suggest_tests(const Scene& scene,
                                         const std::vector<FittedSurface>& surfaces,
                                         CalibrationResult& result) {
  MeasurementTable table;
  std::vector<Candidate> candidates = candidates_of(scene, result.table, table);
  if (table.rows.empty()) return {};
  Predictions predictions(scene, surfaces, table, result.parameters);
  const PredictedTable predicted = predict_table(predictions, result.fit.theta);
  count_poses(predictions.counts(), result);
  for (Candidate& candidate : candidates) rate(result, predicted, table, candidate);
  std::stable_sort(candidates.begin(), candidates.end(), [](const auto& a, const auto& b) {
    return a.test.information > b.test.information;
  });
  std::vector<SuggestedTest> tests;
  for (const Candidate& candidate : candidates) tests.push_back(candidate.test);
  return tests;
}

}  // namespace condyle
