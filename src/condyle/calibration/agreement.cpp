#include "condyle/calibration/agreement.h"

#include <fmt/format.h>

#include <cmath>

#include "condyle/elements/joint_table.h"
#include "condyle/math/no_number.h"

namespace condyle {
namespace {

constexpr double kNormal975 = 1.959963984540054;  // 97.5 % quantile of the normal distribution

/// Root of a mean of squares; NaN of none.
struct Rms {
  double sum = 0;
  int count = 0;
  void add(double x) {
    sum += x * x;
    ++count;
  }
  [[nodiscard]] double value() const { return count > 0 ? std::sqrt(sum / count) : kNoNumber; }
};

Agreement agreement_of(const std::string& name,
                       const std::vector<std::size_t>& which,
                       const MeasurementTable& table,
                       const std::vector<CalibratedRow>& rows) {
  Agreement agreement;
  agreement.name = name;
  Rms before, after, lengths[2], angles[2];
  int covered = 0;
  for (const std::size_t i : which) {
    const Measurement& measured = table.rows[i];
    const CalibratedRow& row = rows[i];
    const double off[2] = {row.before - measured.value, row.after - measured.value};
    ++agreement.rows;
    if (std::isfinite(off[0])) before.add(off[0] / row.sd);
    const bool lost = !std::isfinite(off[1]);
    agreement.lost += lost;
    if (!lost) {
      after.add(off[1] / row.sd);
      covered += std::abs(off[1]) <= kNormal975 * std::hypot(row.sd, row.after_sd);
    }
    if (measured.kind != MeasuredKind::kJointCoordinate) continue;
    for (int when = 0; when < 2; ++when)
      if (std::isfinite(off[when]))
        (kJointCoordinates[measured.index].angle ? angles : lengths)[when].add(off[when]);
  }
  agreement.before = before.value();
  agreement.after = after.value();
  agreement.covered = after.count > 0 ? static_cast<double>(covered) / after.count : kNoNumber;
  agreement.length_before = lengths[0].value();
  agreement.length_after = lengths[1].value();
  agreement.angle_before = angles[0].value();
  agreement.angle_after = angles[1].value();
  return agreement;
}

}  // namespace

Eigen::VectorXd predicted_sd(const Eigen::MatrixXd& J, const Eigen::MatrixXd& C) {
  return (J * C).cwiseProduct(J).rowwise().sum().cwiseMax(0).cwiseSqrt();
}

std::vector<CalibratedRow> calibrated_rows(const PredictedRows& before,
                                           const PredictedRows& after,
                                           const Eigen::VectorXd& prior_sd,
                                           const Eigen::MatrixXd& posterior,
                                           const Eigen::VectorXd& sd) {
  const Eigen::VectorXd prior_of = predicted_sd(before.J, prior_sd.cwiseAbs2().asDiagonal());
  const Eigen::VectorXd after_of = predicted_sd(after.J, posterior);
  std::vector<CalibratedRow> rows(static_cast<std::size_t>(sd.size()));
  for (Eigen::Index i = 0; i < sd.size(); ++i) {
    CalibratedRow& row = rows[static_cast<std::size_t>(i)];
    row.before = before.y[i];
    row.after = after.y[i];
    row.prior_sd = std::isfinite(before.y[i]) ? prior_of[i] : kNoNumber;
    row.after_sd = std::isfinite(after.y[i]) ? after_of[i] : kNoNumber;
    row.sd = sd[i];
  }
  return rows;
}

Agreement agreement_by_use(const std::string& name,
                           MeasuredUse use,
                           const MeasurementTable& table,
                           const std::vector<CalibratedRow>& rows) {
  std::vector<std::size_t> which;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (table.rows[i].use == use) which.push_back(i);
  return agreement_of(name, which, table, rows);
}

std::vector<Agreement> agreement_by_test(const MeasurementTable& table,
                                         const std::vector<CalibratedRow>& rows) {
  std::vector<std::pair<std::string, std::vector<std::size_t>>> tests;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Measurement& row = table.rows[i];
    const std::string name = fmt::format("{}, {:.4g} deg", row.test, row.flexion * 180 / M_PI);
    auto at = std::find_if(tests.begin(), tests.end(), [&](auto& t) { return t.first == name; });
    if (at == tests.end()) at = tests.insert(at, {name, {}});
    at->second.push_back(i);
  }
  std::vector<Agreement> agreements;
  for (const auto& [name, which] : tests)
    agreements.push_back(agreement_of(name, which, table, rows));
  return agreements;
}

double reduced_chi_square_limit(double degrees_of_freedom) {
  if (!(degrees_of_freedom >= 1)) return kNoNumber;
  const double v = 2 / (9 * degrees_of_freedom);
  return std::pow(1 - v + kNormal975 * std::sqrt(v), 3);
}

}  // namespace condyle
