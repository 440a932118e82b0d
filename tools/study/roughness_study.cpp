/// How sure a pose is, given a mesh: the phantom with roughness of known strength, swept on patches that
/// are fitted to it and on its exact surfaces, and what the mesh alone tells of the error
/// (study/mesh_uncertainty.h). Prints tables for docs/study.md.
///
///   condyle_roughness_study SCENE auto|position MESHES JUDGED SWEEPS RMS...
///
/// MESHES of each strength, of which the first JUDGED are asked for their uncertainty, by SWEEPS sweeps
/// each.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "condyle/calibration/in_parallel.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/study/mesh_uncertainty.h"
#include "phantom/exact_motion.h"
#include "phantom/mesh_shape.h"
#include "phantom/roughness.h"

namespace condyle {
namespace {

constexpr double kCorrelation = 1.5;  // [mm]
const double kNoNumber = std::nan("");

struct Asked {
  int meshes = 0, judged = 0, sweeps = 0;
};

/// By poses; one mesh.
using Numbers = std::vector<double>;

/// One quantity over all meshes of one strength, in the unit that it is shown in.
struct Quantity {
  SensitivityOutput output;
  std::string name;
  std::vector<Numbers> error;  ///< by meshes
  std::vector<Numbers> sd;     ///< by judged meshes
};

std::vector<Quantity> quantities_of(const Scene& scene) {
  const std::vector<std::pair<std::string, std::string>> shown = {
      {"joint/adduction", "adduction"},
      {"joint/internal_rotation", "internal rotation"},
      {"joint/lateral_shift", "lateral shift"},
      {"joint/anterior_drawer", "anterior drawer"},
      {"joint/distraction", "distraction"},
      {"contacts/medial/force", "medial force"},
      {"contacts/medial/resultant_x", "medial contact, x"},
      {"contacts/lateral/resultant_x", "lateral contact, x"},
      {"ligaments/aMCL/force", "aMCL force"}};
  std::vector<Quantity> quantities;
  for (const auto& [place, name] : shown)
    for (const SensitivityOutput& output : uncertain_outputs(scene))
      if (output.place == place) quantities.push_back({output, name, {}, {}});
  return quantities;
}

SweepResult plain_sweep(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  SweepOptions options;
  options.stability = options.events = false;
  return sweep(scene, surfaces, options);
}

double number(const Quantity& quantity, const PoseResult& pose) {
  return pose.converged() ? value_of(quantity.output.output, pose) / quantity.output.unit.factor
                          : kNoNumber;
}

/// The knee on one rough mesh.
struct Trial {
  std::vector<FittedSurface> surfaces;
  SweepResult sweep;
  std::shared_ptr<const MeshUncertainty> uncertainty;
};

class Phantom {
 public:
  explicit Phantom(const char* file) : scene_(read_scene(file)) {
    scene_.sweep->values.clear();
    for (int degrees = 0; degrees <= 90; degrees += 10)
      scene_.sweep->values.push_back(degrees * M_PI / 180);
    truth_ = plain_sweep(scene_, phantom::exact_surfaces(scene_));
    for (const phantom::Bone bone : {phantom::Bone::kFemur, phantom::Bone::kTibia})
      smooth_.push_back(phantom::mesh_bone(bone, phantom::kResolution));
  }

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const SweepResult& truth() const { return truth_; }

  [[nodiscard]] Trial trial(const Scene& scene, double rms, int seed, int sweeps) const {
    const MeshReader read = [&](const MeshFile& file) {
      const bool femur = file.path.stem() == "femur";
      TriangleMesh mesh = smooth_[femur ? 0 : 1];
      phantom::roughen(femur ? phantom::Bone::kFemur : phantom::Bone::kTibia,
                       {rms, kCorrelation, static_cast<std::uint64_t>(seed)}, mesh);
      return mesh;
    };
    Trial trial;
    trial.surfaces = fit_surfaces(scene, {}, read, 1);
    trial.sweep = plain_sweep(scene, trial.surfaces);
    StudyProgress silent({});
    if (sweeps > 0)
      trial.uncertainty =
          mesh_uncertainty(scene, trial.surfaces, trial.sweep.poses, {sweeps, 1, 1}, silent);
    return trial;
  }

 private:
  Scene scene_;
  SweepResult truth_;
  std::vector<TriangleMesh> smooth_;
};

void add(const Phantom& knee, const Trial& trial, Quantity& quantity) {
  Numbers error, sd;
  for (std::size_t pose = 0; pose < trial.sweep.poses.size(); ++pose)
    error.push_back(number(quantity, trial.sweep.poses[pose]) -
                    number(quantity, knee.truth().poses[pose]));
  quantity.error.push_back(error);
  if (!trial.uncertainty) return;
  const std::vector<SensitivityOutput>& outputs = trial.uncertainty->outputs;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].place != quantity.output.place) continue;
    for (const double value : trial.uncertainty->sd[i])
      sd.push_back(value / outputs[i].unit.factor);
  }
  quantity.sd.push_back(sd);
}

/// Root mean square of finite numbers.
struct Rms {
  double squares = 0, count = 0;
  void add(double value) {
    if (!std::isfinite(value)) return;
    squares += value * value;
    ++count;
  }
  [[nodiscard]] double value() const { return std::sqrt(squares / count); }
};

/// Mean over meshes at each pose, and spread about it.
struct Split {
  Rms bias, spread, error;
};
Split split(const std::vector<Numbers>& error) {
  Split split;
  for (std::size_t pose = 0; pose < error.front().size(); ++pose) {
    double sum = 0, count = 0, squares = 0;
    for (const Numbers& mesh : error)
      if (std::isfinite(mesh[pose])) sum += mesh[pose], ++count;
    for (const Numbers& mesh : error) {
      split.error.add(mesh[pose]);
      if (std::isfinite(mesh[pose])) squares += std::pow(mesh[pose] - sum / count, 2);
    }
    split.bias.add(sum / count);
    split.spread.add(std::sqrt(squares / (count - 1)));
  }
  return split;
}

/// Percent of errors within the interval of 95 % about the pose: Student's t for that many sweeps.
double covered(const Quantity& quantity, double times) {
  double within = 0, all = 0;
  for (std::size_t mesh = 0; mesh < quantity.sd.size(); ++mesh)
    for (std::size_t pose = 0; pose < quantity.sd[mesh].size(); ++pose) {
      const double error = quantity.error[mesh][pose], sd = quantity.sd[mesh][pose];
      if (!std::isfinite(error) || !std::isfinite(sd)) continue;
      ++all;
      within += std::abs(error) <= times * sd ? 1 : 0;
    }
  return 100 * within / all;
}

std::string row_of(double rms, const Quantity& quantity) {
  const Split errors = split(quantity.error);
  std::string row = fmt::format("| {:g} | {} {} | {:.2f} | {:.2f} | {:.2f} |", rms, quantity.name,
                                quantity.output.unit.name, errors.bias.value(),
                                errors.spread.value(), errors.error.value());
  if (quantity.sd.empty()) return row + "\n";
  Rms told;
  for (const Numbers& mesh : quantity.sd)
    for (const double value : mesh) told.add(value);
  constexpr double kStudent = 2.09;  // 19 degrees of freedom
  return row + fmt::format(" {:.2f} | {:.2f} | {:.2f} | {:.0f} |\n", told.value(),
                           told.value() / errors.spread.value(),
                           told.value() / errors.error.value(), covered(quantity, kStudent));
}

/// Of one strength: rows of quantities, and one of all.
struct Rows {
  std::string quantities, whole;
};

Rows study(const Phantom& knee, bool position, double rms, const Asked& asked) {
  Scene scene = knee.scene();
  for (SurfaceDescription& surface : scene.surfaces) surface.patch.smooth_for_position = position;
  std::vector<Trial> trials(static_cast<std::size_t>(asked.meshes));
  StudyProgress silent({});
  const auto make_task = [&] {
    return [&](int k) {
      try {
        trials[static_cast<std::size_t>(k)] =
            knee.trial(scene, rms, k + 1, k < asked.judged ? asked.sweeps : 0);
      } catch (const InputError&) {
        // The mesh is refused: none of its poses is found.
      }
    };
  };
  (void)in_parallel("meshes", asked.meshes, 0, make_task, silent);
  std::vector<Quantity> quantities = quantities_of(scene);
  int poses = 0, converged = 0;
  Rms strength, length, smoothing;
  for (const Trial& trial : trials) {
    poses += static_cast<int>(knee.truth().poses.size());
    if (trial.surfaces.empty()) continue;
    for (Quantity& quantity : quantities) add(knee, trial, quantity);
    converged += trial.sweep.count_converged();
    for (const FittedSurface& surface : trial.surfaces)
      smoothing.add(surface.report->smoothing_length);
    if (!trial.uncertainty) continue;
    for (const RoughSurface& surface : trial.uncertainty->surfaces) {
      strength.add(surface.texture.rms);
      length.add(surface.texture.correlation);
    }
  }
  Rows rows;
  rows.whole =
      fmt::format("| {:g} | {:.1f} | {} of {} |", rms, smoothing.value(), converged, poses);
  if (strength.count > 0)
    rows.whole += fmt::format(" {:.2f} | {:.1f} |", strength.value(), length.value());
  rows.whole += "\n";
  for (const Quantity& quantity : quantities) rows.quantities += row_of(rms, quantity);
  return rows;
}

void print(const std::vector<Rows>& all, bool told) {
  fmt::print("| roughness mm | quantity | bias | spread | error |{}\n|---|---|---|---|---|{}\n",
             told ? " told sd | told / spread | told / error | within 95 % |" : "",
             told ? "---|---|---|---|" : "");
  for (const Rows& rows : all) fmt::print("{}", rows.quantities);
  fmt::print("\n| roughness mm | smoothing mm | poses |{}\n|---|---|---|{}\n",
             told ? " told mm | told l mm |" : "", told ? "---|---|" : "");
  for (const Rows& rows : all) fmt::print("{}", rows.whole);
}

}  // namespace
}  // namespace condyle

int main(int argc, char** argv) {
  try {
    if (argc < 7)
      throw condyle::InputError(
          "condyle_roughness_study: expected SCENE auto|position MESHES JUDGED SWEEPS RMS...");
    const condyle::Phantom knee(argv[1]);
    const bool position = std::string(argv[2]) == "position";
    const condyle::Asked asked{std::atoi(argv[3]), std::atoi(argv[4]), std::atoi(argv[5])};
    std::vector<condyle::Rows> rows;
    for (int i = 6; i < argc; ++i)
      rows.push_back(condyle::study(knee, position, std::atof(argv[i]), asked));
    condyle::print(rows, asked.judged > 0);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
