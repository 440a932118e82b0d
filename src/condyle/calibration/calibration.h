#pragma once

/// A knee fitted to measurements, with all that a reader has to know to trust it or not: plain data,
/// and the one door that makes it.

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "condyle/calibration/free_parameter.h"
#include "condyle/calibration/identifiability.h"
#include "condyle/calibration/least_squares.h"
#include "condyle/calibration/measurement_table.h"
#include "condyle/scene/fitted_surface.h"

namespace condyle {

/// A row of the table, with what the knee answers before and after [unit inside].
struct CalibratedRow {
  double before = 0,
         after = 0;  ///< predictions at the scene's numbers and at the fitted ones; NaN: no pose
  double prior_sd = 0,
         after_sd = 0;  ///< of those predictions, by prior and posterior of θ (delta method)
  double sd = 0;        ///< of the measurement, with what flexion and level add, and of an unseen
                        ///< curve the zero of its own
};

/// How well a set of rows is met.
struct Agreement {
  std::string name;              ///< "fitted", "unseen", or a test with its flexion
  int rows = 0, lost = 0;        ///< lost: no pose
  double before = 0, after = 0;  ///< rms of (y - d)/sd
  double covered = 0;            ///< share within 1.96 sqrt(sd² + after_sd²) of the prediction
  double length_after = 0, angle_after = 0;  ///< rms of displacements [mm], angles [rad]; NaN: none
  double length_before = 0, angle_before = 0;
};

/// A coordinate or force over flexion, by prior and posterior: mean and sd by the delta method.
struct Band {
  std::string quantity;                                    ///< "anterior_drawer", "aACL.force"
  std::string units;                                       ///< as told: mm, deg, N
  std::vector<double> before, before_sd, after, after_sd;  ///< in those units; NaN: no pose
};

/// One parameter held at a value while all others are fitted anew.
struct Profile {
  std::size_t parameter = 0;
  std::vector<double> theta, chi_square;  ///< chi square with the prior's part, above the least
};

/// One start of the search for the least.
struct CalibrationStart {
  double cost = 0;
  double distance = 0;  ///< of its θ from the best [prior sd, largest component]
  bool converged = false;
  int iterations = 0;
  std::string message;
};

/// A test that was not made, and what it would tell (suggest_tests.h).
struct SuggestedTest {
  double flexion = 0;  ///< [rad]
  int load = -1;       ///< of CalibrationDescription::loads
  double level = 0;
  double information = 0;  ///< ½ ln det of posterior precision after over before [-]: D-optimality
  double shrinkage =
      0;               ///< mean of posterior sd after over before, over the parameters of the knee
  std::string reason;  ///< no pose there
};

struct CalibrationResult {
  MeasurementTable table;
  std::vector<FreeParameter> parameters;
  Eigen::VectorXd prior_sd;
  LeastSquaresResult fit;  ///< the best of all starts; rows that are fitted
  std::vector<CalibrationStart> starts;
  Identifiability known;            ///< at the fit
  std::vector<bool> at_bound;       ///< of each θ: its sd is that of none
  std::vector<CalibratedRow> rows;  ///< of the table
  Agreement fitted, unseen;
  std::vector<Agreement> tests;  ///< by curve and flexion
  double reduced_chi_square =
      0;  ///< chi²/(n - effective); above 1: the model is wrong or sds too small
  double reduced_chi_square_limit = 0;  ///< its 97.5 % quantile where the model is right
  Eigen::MatrixXd samples;              ///< of the posterior, a row each (randomise, then optimise)
  int lost_samples = 0;
  Eigen::VectorXd
      sample_sd;  ///< of them; where it parts from known.sd by 10 % it is the one to take
  std::vector<std::string> silent;    ///< ligaments that carry nothing in any fitted test
  double cold_difference = 0;         ///< Predictions::difference_of_cold_path
  std::vector<double> band_flexions;  ///< [rad]
  std::vector<Band> bands;
  std::vector<Profile> profiles;
  std::vector<SuggestedTest> suggested;  ///< best first; only where asked for
  double seconds = 0, fit_seconds = 0;
  long poses = 0, failed_poses = 0;
  bool stopped = false;  ///< by Ctrl-C: the best so far, no samples
};

struct CalibrationOptions {
  bool suggest = false;
  bool bands = true, profiles = true;
  std::optional<int> samples, starts;  ///< in place of the scene's
  int threads =
      0;  ///< for starts, profiles and samples; 0: one a core. The same bits with any number
  std::optional<Eigen::VectorXd> from;  ///< θ of an earlier fit that was stopped: its first start
  /// Told of what is done, in words and numbers; false: stop.
  std::function<bool(const std::string& stage, int done, int total)> on_progress;
  /// Told of the best θ so far whenever it changes.
  std::function<void(const Eigen::VectorXd& theta, double cost)> on_better;
};

/// `surfaces` as from fit_surfaces, `table` as from read_measurements, `meshes` as by Scene::bodies (body frame [mm], empty where none).
/// Needs scene.calibration. Throws InputError as free_parameters and Predictions
/// do, and for more parameters than fitted rows without a prior that holds them.
[[nodiscard]] CalibrationResult calibrate(const Scene& scene,
                                          const std::vector<FittedSurface>& surfaces,
                                          const MeasurementTable& table,
                                          const std::vector<TriangleMesh>& meshes,
                                          const CalibrationOptions& options = {});

}  // namespace condyle
