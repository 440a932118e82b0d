#pragma once

/// What the parts of condyle_strangers share: the knees, the program under test, the page that is written, and how outcomes
/// become its rows.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "strangers/stranger_jobs.h"

namespace condyle::strangers {

using Outcomes = std::vector<std::vector<Outcome>>;

inline constexpr const char* kSweep = "--from 0 --to 120 --step 5";

struct Study {
  std::filesystem::path program, source, scratch;
  int threads = 1;
  bool quick = false;
  std::size_t rough_sweeps = 2000;
  std::string page;
  bool met = true;             ///< every figure that was wanted
  double slowest_failing = 0;  ///< [s]
  std::string slowest;
  std::vector<std::string> absent;

  struct Source {
    std::string name;
    std::filesystem::path scene;
  };
  std::vector<Source> population, specimens, shipped;

  /// Every knee: those shipped, the specimens, the population.
  [[nodiscard]] std::vector<Source> all() const;
  /// Runs the program, and keeps which pose took longest to fail.
  [[nodiscard]] Outcomes run(const std::vector<Job>& jobs);
  void write(const std::string& line) { page += line + "\n"; }
  /// A row "| what | wanted | found |".
  void figure(const std::string& what,
              const std::string& wanted,
              const std::string& found,
              bool ok);
  /// A row of kCountHead.
  void count_row(const std::string& name, const std::vector<Outcome>& outcomes);
  /// The first of what went wrong, if anything.
  void write_faults(const std::vector<Outcome>& outcomes);
};

inline constexpr const char* kCountHead =
    "| knee | poses | converged | of those false | the others |\n|---|---|---|---|---|";

[[nodiscard]] std::function<Knee()> reader(const Study::Source& source);

/// Those that are there; the names of the others are kept.
void find_knees(Study& study);

[[nodiscard]] std::vector<Outcome> flat(const Outcomes& outcomes);
[[nodiscard]] int sum_false(const std::vector<Outcome>& outcomes);

/// How far the poses of several knees are from those of the same knees solved another way.
class Agreement {
 public:
  void add(const std::string& knee, const Outcome& here, const Outcome& there);
  /// "| greatest difference, knee | other status | false |", the end of a row; `tolerance` in deg and mm.
  [[nodiscard]] std::string row(double tolerance) const;
  [[nodiscard]] bool within(double tolerance) const {
    return worst_.greatest <= tolerance && worst_.statuses == 0 && false_poses_ == 0 && lost_ == 0;
  }

 private:
  Difference worst_;
  std::string where_;
  int false_poses_ = 0, lost_ = 0;
};

}  // namespace condyle::strangers
