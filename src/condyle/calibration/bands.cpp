#include "condyle/calibration/bands.h"

#include <algorithm>

#include "condyle/calibration/predicted_table.h"
#include "condyle/elements/joint_table.h"

namespace condyle {
namespace {

constexpr int kAngles = 25;

struct Quantity {
  std::string name;
  MeasuredKind kind;
  std::size_t index;
};

std::vector<Quantity> quantities_of(const Scene& scene) {
  std::vector<Quantity> quantities;
  for (std::size_t i = 1; i < kJointCoordinates.size(); ++i)  // flexion is prescribed
    quantities.push_back({kJointCoordinates[i].name, MeasuredKind::kJointCoordinate, i});
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
    quantities.push_back({scene.ligaments[i].name + ".force", MeasuredKind::kLigamentForce, i});
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    quantities.push_back({scene.contacts[i].name + ".force", MeasuredKind::kContactForce, i});
  return quantities;
}

/// Quantity by quantity, each over all flexions.
MeasurementTable table_of(const std::vector<Quantity>& quantities,
                          const std::vector<double>& flexions) {
  MeasurementTable table;
  for (const Quantity& quantity : quantities)
    for (const double flexion : flexions)
      table.rows.push_back(predicted_row(flexion, quantity.kind, quantity.index));
  return table;
}

/// The knee without the frames and zeros of its measurement.
struct KneeOnly {
  std::vector<FreeParameter> parameters;
  std::vector<Eigen::Index> places;  ///< of them among all
};

KneeOnly knee_only(const std::vector<FreeParameter>& parameters) {
  KneeOnly knee;
  for (std::size_t j = 0; j < parameters.size(); ++j)
    if (!parameters[j].nuisance()) {
      knee.parameters.push_back(parameters[j]);
      knee.places.push_back(static_cast<Eigen::Index>(j));
    }
  return knee;
}

Band band_of(const Quantity& quantity,
             const std::vector<CalibratedRow>& rows,
             std::size_t first,
             std::size_t count,
             const Unit& unit) {
  Band band{quantity.name, unit.name, {}, {}, {}, {}};
  for (std::size_t i = first; i < first + count; ++i) {
    band.before.push_back(rows[i].before / unit.factor);
    band.before_sd.push_back(rows[i].prior_sd / unit.factor);
    band.after.push_back(rows[i].after / unit.factor);
    band.after_sd.push_back(rows[i].after_sd / unit.factor);
  }
  return band;
}

}  // namespace

std::vector<double> band_flexions(const Scene& scene, const MeasurementTable& table) {
  if (scene.sweep && !scene.sweep->varies_load && scene.sweep->index == scene.calibration->flexion)
    return scene.sweep->values;
  const auto [least, most] =
      std::minmax_element(table.rows.begin(), table.rows.end(),
                          [](const auto& a, const auto& b) { return a.flexion < b.flexion; });
  if (least == table.rows.end()) return {};
  if (least->flexion == most->flexion) return {least->flexion};
  std::vector<double> angles;
  for (int k = 0; k < kAngles; ++k)
    angles.push_back(least->flexion + (most->flexion - least->flexion) * k / (kAngles - 1));
  return angles;
}

std::vector<Band> find_bands(const Scene& scene,
                             const std::vector<FittedSurface>& surfaces,
                             CalibrationResult& result) {
  const std::vector<Quantity> quantities = quantities_of(scene);
  const MeasurementTable table = table_of(quantities, result.band_flexions);
  const KneeOnly knee = knee_only(result.parameters);
  Predictions predictions(scene, surfaces, table, knee.parameters);
  const PredictedTable predicted = predict_table(predictions, result.fit.theta(knee.places));
  count_poses(predictions.counts(), result);
  const std::vector<CalibratedRow> rows =
      calibrated_rows(predicted.before, predicted.after, result.prior_sd(knee.places),
                      result.known.covariance(knee.places, knee.places),
                      Eigen::VectorXd::Ones(predicted.after.y.size()));
  std::vector<Band> bands;
  const std::size_t count = result.band_flexions.size();
  for (std::size_t q = 0; q < quantities.size(); ++q)
    bands.push_back(
        band_of(quantities[q], rows, q * count, count, unit_of(table.rows[q * count], scene)));
  return bands;
}

}  // namespace condyle
