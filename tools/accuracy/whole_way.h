#pragma once

/// The ways from a mesh to swept poses that are compared, and their table.

#include <fmt/os.h>

#include <string>
#include <utility>
#include <vector>

#include "accuracy/phantom_truth.h"

namespace condyle::accuracy {

inline constexpr double kKnots = 2;  ///< what the program takes by itself [mm]

enum class Smoothing { kChosen, kGiven };

/// What is made, fitted and swept. Lengths in mm.
struct Way {
  std::string group;
  double cell = 1.4, roughness = 0;
  int seeds = 1;
  Smoothing smoothing = Smoothing::kChosen;
  double length = 0;  ///< of smoothing, where given
  double knots = kKnots;
  bool exact_condyles = false, exact_plateaus = false;  ///< in place of the fitted ones
  double correlation = 1.5;                             ///< length, of the roughness
};

struct Outcome {
  PoseErrors pose;
  PatchErrors patch;
  double triangles = 0;       ///< of both meshes
  double read_ms = 1e300;     ///< both meshes, alone; this and the next two the least of the seeds
  double patches_ms = 1e300;  ///< from the files, reading included
  double pose_us = 1e300;     ///< median of a sweep
  double sweep_ms = 0;        ///< sum over the seeds; a pose that is hard to find makes it long
  std::string refused;        ///< why a mesh was not fitted
  int sweeps = 0;
  [[nodiscard]] double mean_sweep_ms() const { return sweeps > 0 ? sweep_ms / sweeps : 0; }
  /// From the mesh files to a sweep of ten poses.
  [[nodiscard]] double total_ms() const { return patches_ms + mean_sweep_ms(); }
  [[nodiscard]] bool complete() const {
    return refused.empty() && pose.poses > 0 && pose.converged == pose.poses;
  }
};

/// What stands above the table: `solver` are poses on the exact surfaces found in other steps.
[[nodiscard]] std::string introduction(const PoseErrors& solver);
[[nodiscard]] std::string row(const Way& way, const Outcome& outcome);

void write_head(fmt::ostream& csv);
void write(const Way& way, const Outcome& outcome, fmt::ostream& csv);

/// What an answer good to 0.1 mm and 0.1 degrees at every pose costs: the cheapest of the rows.
[[nodiscard]] std::string price(const std::vector<std::pair<Way, Outcome>>& all);

/// What limits the answer.
[[nodiscard]] std::vector<std::string> in_short(const std::vector<std::pair<Way, Outcome>>& all);

}  // namespace condyle::accuracy
