#pragma once

/// A run on disk: HDF5 as shared between programs (format "condyle 1"). All the reader of pictures
/// needs is inside: the scene text, poses, patches, and the bodies' meshes.

#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/mesh/triangle_mesh.h"
#include "condyle/results/read_by.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"
#include "condyle/surface/patch.h"

namespace condyle {

struct BodyMesh {
  std::string name;   ///< of the body
  TriangleMesh mesh;  ///< body frame [mm]; may be empty
};

struct RunPatch {
  std::string surface;  ///< name of the surface in the scene
  int body = -1;
  PatchData data;
  FitReport report;
};

/// A mesh file that a run was computed from.
struct InputFile {
  std::string file;    ///< as it was opened
  std::string sha256;  ///< of its bytes, in hexadecimal digits
};

// What a study has beside poses: who asks for it includes compare/compare.h, compare/laxity.h,
// network/simulate.h or calibration/calibration.h.
struct CalibrationResult;
struct Comparison;
struct LaxityResult;
struct MeshUncertainty;  ///< study/mesh_uncertainty.h
struct Simulation;
struct SweepSensitivities;  ///< equilibrium/sweep_sensitivities.h

/// Which command a run is of. Its scene, which may hold the tables of several, does not say.
enum class RunKind { kSweep, kFit, kComparison, kLaxity, kSimulation, kCalibration };

struct SweepStudy {};  ///< all there is to know are the poses
struct FitStudy {};    ///< and here there are none

/// In the order of RunKind.
using RunStudy = std::variant<SweepStudy,
                              FitStudy,
                              std::shared_ptr<const Comparison>,
                              std::shared_ptr<const LaxityResult>,
                              std::shared_ptr<const Simulation>,
                              std::shared_ptr<const CalibrationResult>>;

struct Run {
  Scene scene;        ///< as it was read
  SweepResult sweep;  ///< of a comparison our poses, of a motion its frames; of others none
  std::vector<RunPatch> patches;
  std::vector<BodyMesh> bodies;
  RunStudy study = SweepStudy{};
  std::vector<std::string> start = {};  ///< what start_warnings found
  std::vector<InputFile> inputs = {};   ///< the meshes; none in files of version 0.1.0
  /// Where the sweep asks for them; else null.
  std::shared_ptr<const SweepSensitivities> sensitivities = {};
  /// Of a sweep where it was asked for; else null.
  std::shared_ptr<const MeshUncertainty> uncertainty = {};
  std::string program = {}, created = {};  ///< read back only: who wrote the file, and when (UTC)

  [[nodiscard]] RunKind kind() const { return static_cast<RunKind>(study.index()); }
  /// Null for runs of another kind.
  [[nodiscard]] const Comparison* comparison() const { return held<Comparison>(); }
  [[nodiscard]] const LaxityResult* laxity() const { return held<LaxityResult>(); }
  /// Read back it has no poses of its own.
  [[nodiscard]] const Simulation* simulation() const { return held<Simulation>(); }
  [[nodiscard]] const CalibrationResult* calibration() const { return held<CalibrationResult>(); }

 private:
  template <typename T>
  [[nodiscard]] const T* held() const {
    const auto* pointer = std::get_if<std::shared_ptr<const T>>(&study);
    return pointer != nullptr ? pointer->get() : nullptr;
  }
};

/// Writes to a temporary file beside `path` and renames it: never a half-written file. Throws
/// InputError when the folder does not exist or the disk is full.
void write_run(const std::filesystem::path& path, const Run& run);

/// Throws InputError for a file that is missing or is not a run.
[[nodiscard]] Run read_run(const std::filesystem::path& path, ReadBy by = ReadBy::kProcessOfItsOwn);

}  // namespace condyle
