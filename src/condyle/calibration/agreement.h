#pragma once

/// How well a knee meets its measurements, with the intervals of its predictions.

#include <string>
#include <vector>

#include "condyle/calibration/calibration.h"

namespace condyle {

/// What a set of rows is predicted as, at one θ; NaN where there is no pose.
struct PredictedRows {
  Eigen::VectorXd y;
  Eigen::MatrixXd J;
};

/// Standard deviation of each prediction by the delta method, √(j C jᵀ); NaN where there is none.
[[nodiscard]] Eigen::VectorXd predicted_sd(const Eigen::MatrixXd& J, const Eigen::MatrixXd& C);

/// sd: of the measurements. Before with the prior's variance, after with the posterior's.
[[nodiscard]] std::vector<CalibratedRow> calibrated_rows(const PredictedRows& before,
                                                         const PredictedRows& after,
                                                         const Eigen::VectorXd& prior_sd,
                                                         const Eigen::MatrixXd& posterior,
                                                         const Eigen::VectorXd& sd);

/// Of all rows with that use; `rows` as those of the table.
[[nodiscard]] Agreement agreement_by_use(const std::string& name,
                                         MeasuredUse use,
                                         const MeasurementTable& table,
                                         const std::vector<CalibratedRow>& rows);

/// Of each curve at each flexion, in the order of the table: "ap30, 30 deg".
[[nodiscard]] std::vector<Agreement> agreement_by_test(const MeasurementTable& table,
                                                       const std::vector<CalibratedRow>& rows);

/// 97.5 % quantile of χ²/ν [Wilson 1931]: to 2 % at ν = 1, to 0.1 % from ν = 10 on. NaN where ν < 1.
[[nodiscard]] double reduced_chi_square_limit(double degrees_of_freedom);

}  // namespace condyle
