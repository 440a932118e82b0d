#pragma once

/// What a knee with changed numbers answers in the tests of a table, with exact derivatives
/// (equilibrium/sensitivity.h): poses of equilibrium, one for each flexion, load and level that a row
/// names, the unloaded ones that relative curves are told from, the opposite ones of laxities.

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "condyle/calibration/free_parameter.h"
#include "condyle/calibration/measurement_table.h"
#include "condyle/scene/fitted_surface.h"

namespace condyle {

struct PredictionParts;

/// Workspace of one thread; those of one knee share its model.
class Predictions {
 public:
  /// Solves all poses at the scene's own numbers, each reached from the start pose over flexions and
  /// levels in steps. Throws InputError, which names file and line, where a row that is fitted has no
  /// pose there.
  Predictions(const Scene& scene,
              const std::vector<FittedSurface>& surfaces,
              const MeasurementTable& table,
              const std::vector<FreeParameter>& parameters);
  /// For another thread, in the same state.
  Predictions(const Predictions& other);
  ~Predictions();

  [[nodiscard]] std::size_t rows() const;        ///< of the table
  [[nodiscard]] std::size_t parameters() const;  ///< θ

  /// y: a prediction for each row of the table, in its unit inside; J: ∂y/∂θ, null: not asked for.
  /// Each pose starts from its own last one. False where a row that is fitted has no pose: the poses
  /// then start as before, and `failure` says which row and why. Predicted rows without one are NaN.
  bool evaluate(const Eigen::VectorXd& theta, Eigen::VectorXd& y, Eigen::MatrixXd* J);
  [[nodiscard]] const std::string& failure() const;

  /// The same at that θ, but each pose reached from the start pose anew: largest difference of y over
  /// sd, NaN where a pose was not found that way. Another branch of equilibria shows here.
  double difference_of_cold_path(const Eigen::VectorXd& theta);

  /// As at the scene's own numbers: what is solved next does not depend on what was solved before.
  void reset();

  /// Poses solved, and those that failed, since it was made.
  struct Counts {
    long poses = 0, failures = 0;
  };
  [[nodiscard]] Counts counts() const;

  /// At θ: how much of the variance of each row is that of flexion and level (calibration_description.h).
  Eigen::VectorXd input_variance(const Eigen::VectorXd& theta);

  /// Largest force of each ligament over all poses of fitted rows [N] at the last θ evaluated.
  [[nodiscard]] std::vector<double> largest_ligament_forces() const;

 private:
  std::unique_ptr<PredictionParts> parts_;
};

}  // namespace condyle
