#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "accuracy/phantom_regions.h"
#include "accuracy/phantom_truth.h"
#include "accuracy/smoothed_poses.h"
#include "accuracy/study.h"
#include "condyle/surface/fit_patch.h"
#include "phantom/mesh_shape.h"
#include "phantom/roughness.h"

namespace condyle::accuracy {
namespace {

constexpr double kGrid = 1.4;                                                             // [mm]
constexpr double kAmplitudes[] = {0.05, 0.1, 0.2, 0.3}, kCorrelations[] = {0.5, 1.5, 3};  // [mm]
constexpr std::uint64_t kSeeds = 4;
constexpr int kLengths = 9;  // of the scan, from 1 to 6 mm

/// A patch through so many fields of one texture, with the lengths that were chosen and with each
/// of the scan.
struct Case {
  double amplitude, correlation;
  std::vector<PhantomRegion> data = {};  ///< by seed
  PatchErrors chosen = {}, for_position = {};
  std::array<PatchErrors, kLengths> scan = {};
  [[nodiscard]] const std::string& name() const { return data.front().name; }
  /// Of `error`: that of a choice over the least of the scan.
  [[nodiscard]] double ratio(const PatchErrors& choice, Spread PatchErrors::*error) const {
    return (choice.*error).rms() / least(error);
  }
  [[nodiscard]] double least(Spread PatchErrors::*error) const {
    double least = 1e300;
    for (const PatchErrors& errors : scan) least = std::min(least, (errors.*error).rms());
    return least;
  }
};

std::vector<Case> cases() {
  using phantom::Bone;
  std::vector<Case> all;
  const TriangleMesh femur = phantom::mesh_bone(Bone::kFemur, kGrid);
  const TriangleMesh tibia = phantom::mesh_bone(Bone::kTibia, kGrid);
  for (const double amplitude : kAmplitudes)
    for (const double correlation : kCorrelations) {
      std::array<Case, 4> patches;
      patches.fill({amplitude, correlation});
      for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        TriangleMesh rough_femur = femur, rough_tibia = tibia;
        phantom::roughen(Bone::kFemur, {amplitude, correlation, seed}, rough_femur);
        phantom::roughen(Bone::kTibia, {amplitude, correlation, seed}, rough_tibia);
        std::vector<PhantomRegion> regions = phantom_regions(rough_femur, rough_tibia);
        for (std::size_t i = 0; i < patches.size(); ++i)
          patches[i].data.push_back(std::move(regions[i]));
      }
      for (Case& one : patches) all.push_back(std::move(one));
    }
  return all;
}

void solve(Case& one) {
  for (const PhantomRegion& data : one.data) {
    one.chosen.add(data.bone, Patch(fit_patch(data.region).patch));
    const FitOptions positions{.aim = SmoothingAim::kPositions};
    one.for_position.add(data.bone, Patch(fit_patch(data.region, positions).patch));
    for (std::size_t k = 0; k < kLengths; ++k) {
      FitOptions options;
      options.smoothing_length = std::pow(1.25, k);
      one.scan[k].add(data.bone, Patch(fit_patch(data.region, options).patch));
    }
  }
}

/// On as many threads as there are cores: no times are taken here.
void solve_all(std::vector<Case>& all) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < all.size(); i = next++) solve(all[i]);
  };
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
}

/// Of ratios.
struct Ratios {
  double sum = 0, worst = 0;
  int count = 0, near = 0;
  void add(double ratio) {
    sum += ratio;
    worst = std::max(worst, ratio);
    ++count;
    near += ratio <= 1.2 ? 1 : 0;
  }
  [[nodiscard]] double mean() const { return count > 0 ? sum / count : 0; }
};

}  // namespace

Study study_smoothing(const Setting& setting) {
  std::vector<Case> all = cases();
  solve_all(all);
  fmt::ostream csv = setting.table("smoothing");
  csv.print("patch,amplitude_mm,correlation_mm,chosen_error_mm,best_error_mm\n");
  Ratios position, normal, curvature, old_normal, old_curvature;
  for (const Case& one : all) {
    csv.print("\"{}\",{},{},{:.4f},{:.4f}\n", one.name(), one.amplitude, one.correlation,
              one.for_position.position.rms(), one.least(&PatchErrors::position));
    position.add(one.ratio(one.for_position, &PatchErrors::position));
    normal.add(one.ratio(one.chosen, &PatchErrors::normal));
    old_normal.add(one.ratio(one.for_position, &PatchErrors::normal));
    curvature.add(one.ratio(one.chosen, &PatchErrors::curvature));
    old_curvature.add(one.ratio(one.for_position, &PatchErrors::curvature));
  }
  Study study;
  study.page = fmt::format(
      "The phantom's four patches on a grid of {} mm with a texture of each strength and "
      "correlation, {} fields of each together: error of position with the length that "
      "`smoothing = \"position\"` chooses over the least of nine lengths (1 to 6 mm), which takes "
      "knowing the truth. Mean and "
      "worst of the four patches, in brackets the error that the best length leaves:\n\n"
      "| texture [mm] |",
      kGrid, kSeeds);
  for (const double correlation : kCorrelations)
    study.page += fmt::format(" correlation {} mm |", correlation);
  study.page += "\n|---|---|---|---|\n";
  for (const double amplitude : kAmplitudes) {
    study.page += fmt::format("| {} |", amplitude);
    for (const double correlation : kCorrelations) {
      Ratios ratios;
      double best = 0;
      for (const Case& one : all) {
        if (one.amplitude != amplitude || one.correlation != correlation) continue;
        ratios.add(one.ratio(one.for_position, &PatchErrors::position));
        best += one.least(&PatchErrors::position) / 4;
      }
      study.page += fmt::format(" {:.2f}, {:.2f} ({:.3f} mm) |", ratios.mean(), ratios.worst, best);
    }
    study.page += "\n";
  }
  study.page += fmt::format(
      "\nAll together: {:.2f} on average, within 1.2 in {} of {}, at worst {:.2f}. Normals {:.2f} "
      "and curvature {:.2f} times the least of the scan on average, with `\"auto\"` {:.2f} and "
      "{:.2f}.\n",
      position.mean(), position.near, position.count, position.worst, old_normal.mean(),
      old_curvature.mean(), normal.mean(), curvature.mean());
  study.require(position.mean() <= 1.2, "the smoothing is on average within 20 % of the best");
  study.in_short = {fmt::format(
      "**The smoothing that the program chooses leaves {:.2f} times the error of normals of the "
      "best "
      "one length made knowing the truth** on average; chosen for position it leaves {:.2f} times "
      "the error of position ({} patches and textures).",
      normal.mean(), position.mean(), position.count)};
  study_smoothed_poses(setting, study);
  return study;
}

}  // namespace condyle::accuracy
