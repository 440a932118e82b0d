#pragma once

/// What a study file asks for: which knees, which of their numbers vary and how, how many samples, and
/// what is kept of each. Plain data in the units used inside; a study file refers to scenes by path.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/scene/calibration_description.h"

namespace condyle {

/// How the points of a study are spread over what varies.
enum class DesignKind {
  kMonteCarlo,      ///< independent points
  kLatinHypercube,  ///< each coordinate once in each of n equal parts
  kSobol,           ///< points of Sobol's sequence, shifted digitally
  kSaltelli,  ///< blocks A, B, AB_1 ... AB_d of Sobol points: what Sobol's indices are told from
  kGrid,      ///< all combinations of equally spaced levels
  kTable      ///< points of a table (CSV)
};

/// Numbers that vary together or each by itself ([[vary]]): `prior_sd` of a normal distribution about
/// the scene's value, cut at the bounds; or uniform over `range`.
struct VariedNumber {
  CalibrationParameter number;
  /// Of the change from the scene's value: [-] of strains, [mm] of lengths and insertions; of a
  /// stiffness or a load of the factor on it.
  std::optional<std::array<double, 2>> range;
};

/// Each sample has a mesh of its own, whose vertices are moved along its normals by a random field
/// with correlation exp(-d²/2l²) ([[vary]] what = "roughness").
struct VariedRoughness {
  double rms = 0;          ///< [mm]
  double correlation = 0;  ///< l [mm]
};

struct StudyDescription {
  std::string title;
  std::string text;                              ///< the whole file
  std::filesystem::path file;                    ///< where it was read
  std::vector<std::filesystem::path> specimens;  ///< scenes, as they can be opened, by name
  DesignKind design = DesignKind::kMonteCarlo;
  std::filesystem::path table;  ///< kTable
  bool table_holds_values =
      false;         ///< kTable: the numbers themselves in place of changes from the scene
  long samples = 0;  ///< of each specimen; of kSaltelli of each block; of kTable 0: all its rows
  int levels = 3;    ///< kGrid
  std::uint64_t seed = 1;
  std::vector<std::string>
      outputs;                    ///< as written; empty: joint coordinates, forces of contacts and
                                  ///< ligaments
  int outputs_line = 0;           ///< where they stand in the file, for messages
  bool single_precision = false;  ///< outputs are kept as float32
  std::optional<VariedRoughness> roughness;
};

}  // namespace condyle
