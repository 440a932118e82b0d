#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/clock.h"
#include "accuracy/phantom_truth.h"
#include "accuracy/study.h"
#include "accuracy/whole_way.h"
#include "condyle/input_error.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle::accuracy {
namespace {

/// The control points for other knots than the program's own, from what it took by itself.
void set_knots(double knots, Scene& scene) {
  if (knots == kKnots) return;
  const std::vector<FittedSurface> own = fit_surfaces(scene);
  for (std::size_t i = 0; i < own.size(); ++i) {
    PatchDescription& patch = scene.surfaces[i].patch;
    std::array<int, 2> count = own[i].report->control_points;
    for (int& n : count)
      n = std::max(
          patch.degree + 1,
          patch.degree + static_cast<int>(std::lround((n - patch.degree) * kKnots / knots)));
    patch.control_points = count;
  }
}

void set_smoothing(const Way& way, Scene& scene) {
  for (SurfaceDescription& surface : scene.surfaces) {
    surface.patch.smoothing.reset();
    if (way.smoothing == Smoothing::kGiven) surface.patch.smoothing = way.length;
  }
}

/// Of the poses after the first, which starts from the scene's estimate [us].
double median_pose_time(const SweepResult& run) {
  std::vector<double> times;
  for (std::size_t i = 1; i < run.poses.size(); ++i)
    if (run.poses[i].converged()) times.push_back(run.poses[i].seconds * 1e6);
  if (times.empty()) return 1e300;
  const auto middle = times.begin() + std::ssize(times) / 2;
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

SweepResult plain_sweep(const Scene& scene, const std::vector<FittedSurface>& surfaces) {
  SweepOptions options;
  options.stability = false;
  options.events = false;
  return sweep(scene, surfaces, options);
}

/// Reading, cleaning and fitting, with the time of each.
std::vector<FittedSurface> make_surfaces(const Scene& scene, Outcome& outcome) {
  const double read = processor_microseconds([&] {
    outcome.triangles = 0;
    for (const BodyDescription& body : scene.bodies)
      outcome.triangles += static_cast<double>(load_body_mesh(body).triangles.size());
  });
  std::vector<FittedSurface> surfaces;
  const double patches = least_microseconds(1, [&] { surfaces = fit_surfaces(scene); });
  outcome.read_ms = std::min(outcome.read_ms, read / 1000);
  outcome.patches_ms = std::min(outcome.patches_ms, patches / 1000);
  return surfaces;
}

void go(const Way& way, Scene scene, const SweepResult& truth, Outcome& outcome) {
  set_smoothing(way, scene);
  set_knots(way.knots, scene);
  std::vector<FittedSurface> surfaces = make_surfaces(scene, outcome);
  const std::vector<FittedSurface> exact = exact_surfaces(scene);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const phantom::Bone bone = bone_of(scene, scene.surfaces[i]);
    if (bone == phantom::Bone::kFemur ? way.exact_condyles : way.exact_plateaus)
      surfaces[i] = exact[i];
    else
      outcome.patch.add(bone, *surfaces[i].surface);
  }
  SweepResult result;
  const double time = processor_microseconds([&] { result = plain_sweep(scene, surfaces); });
  outcome.sweep_ms += time / 1000;
  ++outcome.sweeps;
  outcome.pose_us = std::min(outcome.pose_us, median_pose_time(result));
  outcome.pose.add(result, truth);
}

std::vector<Way> ways() {
  std::vector<Way> all;
  for (const double cell : {2.0, 1.4, 1.0, 0.7}) all.push_back({"resolution", cell});
  for (const double cell : {2.0, 1.4, 1.0, 0.7})
    all.push_back({"resolution, short smoothing", cell, 0, 1, Smoothing::kGiven, 1});
  for (const double knots : {8.0, 4.0, 2.0, 1.4})
    all.push_back({"control points", 0.7, 0, 1, Smoothing::kGiven, 0.5, knots});
  constexpr int kSeeds = 5;
  for (const double roughness : {0.02, 0.05, 0.1, 0.2})
    all.push_back({"roughness", 1.4, roughness, kSeeds});
  all.push_back({"roughness", 0.7, 0.2, kSeeds});
  Way fine{"roughness, correlation 0.5 mm", 0.7, 0.2, kSeeds};
  fine.correlation = 0.5;
  all.push_back(fine);
  for (const double length : {3.0, 4.0, 6.0})
    all.push_back({"smoothing", 1.4, 0.2, kSeeds, Smoothing::kGiven, length});
  Way mixed{"exact condyles", 1.4, 0.2, kSeeds};
  mixed.exact_condyles = true;
  all.push_back(mixed);
  mixed = {"exact plateaus", 1.4, 0.2, kSeeds};
  mixed.exact_plateaus = true;
  all.push_back(mixed);
  return all;
}

}  // namespace

Study study_whole_way(const Setting& setting) {
  const Scene fine = phantom_scene(setting.root, 5), scene = phantom_scene(setting.root, 10);
  const SweepResult truth = plain_sweep(fine, exact_surfaces(fine));
  PoseErrors solver;
  solver.add(plain_sweep(scene, exact_surfaces(scene)), truth);
  fmt::ostream csv = setting.table("whole_way");
  write_head(csv);
  Study study;
  study.page = introduction(solver);
  MeshFiles files(setting.folder / "meshes");
  std::vector<std::pair<Way, Outcome>> all;
  for (const Way& way : ways()) {
    Outcome outcome;
    for (int seed = 1; seed <= way.seeds; ++seed) {
      Scene own = scene;
      files.write({way.cell, way.roughness, way.correlation, seed}, own);
      try {
        go(way, own, truth, outcome);
      } catch (const InputError& error) {
        outcome.refused = error.what();
      }
    }
    study.page += row(way, outcome);
    write(way, outcome, csv);
    all.emplace_back(way, std::move(outcome));
  }
  study.page += price(all);
  study.in_short = in_short(all);
  return study;
}

}  // namespace condyle::accuracy
