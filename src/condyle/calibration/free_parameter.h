#pragma once

/// The numbers of a fit: θ_j is the change of one number of the knee, or of the measurement, from what
/// the scene says; all are 0 there. Their priors are normal with mean 0.

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "condyle/calibration/measurement_table.h"
#include "condyle/equilibrium/model_parameter.h"
#include "condyle/mesh/triangle_mesh.h"

namespace condyle {

struct FreeParameter {
  enum class Kind {
    kNumber,      ///< of the knee: model numbers that move with θ
    kFemurFrame,  ///< nuisance: component 0 to 2 a shift [mm], 3 to 5 a turn [rad] of the frame that
    kTibiaFrame,  ///< the measurement uses against the scene's, along and about the axes of that frame;
                  ///< of a left knee those of the right one that it mirrors
    kCurveOffset  ///< nuisance: added to one coordinate of one curve
  };
  std::string
      name;  ///< "aACL.reference_strain", "pPCL.insertion.tibia.normal", "ap30.anterior_drawer offset"
  std::string units;  ///< of θ: "1", "mm", "rad"
  Kind kind = Kind::kNumber;
  std::size_t asked = 0;  ///< kNumber: which of those that were asked for it comes from
  /// kNumber: each moves by its factor times θ, or by exp(θ) where logarithmic.
  std::vector<std::pair<ModelParameter, double>> moves;
  bool logarithmic = false;    ///< θ = ln(number/number of the scene)
  bool together = false;       ///< several numbers have this one change
  int component = 0;           ///< of a frame
  std::string test;            ///< kCurveOffset: of that curve,
  std::size_t coordinate = 0;  ///< and that joint coordinate
  double prior_sd = 1;
  std::array<double, 2> bounds = {-1e300, 1e300};  ///< of θ
  double start =
      0;  ///< the number itself in the scene; 0 for insertions, frames, offsets and where `together`

  [[nodiscard]] bool nuisance() const { return kind != Kind::kNumber; }
};

/// Those that are asked for, in that order (FreeParameter::asked), all of kind kNumber. Insertions move in
/// the tangent plane and along the normal of the nearest point of their bone (meshes as by
/// Scene::bodies, body frame [mm], empty ones have none: then along the axes of the body, all with
/// prior_sd); what stays then is the slack length where that is free, else the reference strain where it
/// is free or the scene gives one, so that the order of changes does not matter. A transition strain
/// stays above a tenth of itself. Throws InputError, which begins with `where` ("knee.toml:
/// [[calibrate.parameter]]"), for a number that the scene does not have: the strain of a table, a number
/// twice free.
[[nodiscard]] std::vector<FreeParameter> free_numbers(
    const Scene& scene,
    const std::vector<CalibrationParameter>& asked,
    const std::vector<TriangleMesh>& meshes,
    const std::string& where);

/// Those that [calibrate] asks for, in its order, nuisance last. Meshes as by
/// Scene::bodies. Throws InputError for a number that the scene does not have, and for one twice free.
[[nodiscard]] std::vector<FreeParameter> free_parameters(const Scene& scene,
                                                         const std::vector<TriangleMesh>& meshes,
                                                         const MeasurementTable& table);

/// The scene with these changes: laws, insertions and loads.
[[nodiscard]] Scene scene_with(const Scene& scene,
                               const std::vector<FreeParameter>& parameters,
                               const std::vector<double>& theta);

}  // namespace condyle
