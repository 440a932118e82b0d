#pragma once

/// Sweeps of stranger knees by the program itself, as a user runs it, many at a time.

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "strangers/stranger_scene.h"

namespace condyle::strangers {

/// One pose as `--json` tells it.
struct StrangerPose {
  double value = 0;  ///< [deg]
  std::string status;
  double seconds = 0;
  std::vector<double> joint;  ///< [deg], [mm]; empty where it did not converge
};

struct Outcome {
  std::string name;
  std::string error = {};  ///< the program's own line where there is no result
  std::vector<StrangerPose> poses = {};
  int false_poses = 0;
  std::vector<std::string> faults = {};
  double worst_gap = 0;  ///< overlap that `verify` found [mm]
};

struct Job {
  std::string name;
  std::function<Knee()> knee;       ///< made when the job starts
  std::vector<std::string> sweeps;  ///< options of `sweep`; one outcome each
  std::vector<double> loads = {};   ///< [N]; an outcome for each too, loads first; empty: as it is
  bool verify = true;
};

/// Runs all jobs, some at a time, each in a folder of its own under `scratch`; outcomes job by job.
[[nodiscard]] std::vector<std::vector<Outcome>> run_jobs(const std::vector<Job>& jobs,
                                                         const std::filesystem::path& program,
                                                         const std::filesystem::path& scratch,
                                                         int threads);

/// Poses of the outcomes with each status.
[[nodiscard]] std::map<std::string, int> count_statuses(const std::vector<Outcome>& outcomes);

/// The greatest difference of joint coordinates at values that both have converged at, and how many
/// values only one has.
struct Difference {
  double greatest = 0;
  int compared = 0, statuses = 0;
};
[[nodiscard]] Difference difference(const Outcome& a, const Outcome& b);

}  // namespace condyle::strangers
