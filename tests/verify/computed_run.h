#pragma once

/// Runs as the program writes them, for the verifier to look at.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "condyle/results/run_file.h"
#include "support/scratch_folder.h"
#include "support/specimens.h"

namespace condyle::test {

inline const std::filesystem::path kSource = CONDYLE_SOURCE_DIR;

/// `command` of the program on a scene, read back; poses that did not succeed are the test's to
/// look at.
inline Run computed_run(const std::filesystem::path& scene, const std::string& command = "sweep") {
  const std::filesystem::path folder = fresh_folder("condyle verify run");
  const std::filesystem::path file = folder / "run.h5";
  const std::string line = "'" CONDYLE_PROGRAM "' " + command + " \"" + scene.string() +
                           "\" -o \"" + file.string() + "\" --quiet 2> /dev/null";
  EXPECT_GE(std::system(line.c_str()), 0);
  Run run = read_run(file);
  std::filesystem::remove_all(folder);
  return run;
}

/// The phantom's sweep, computed once for all tests of a program.
inline const Run& phantom_run() {
  static const Run run = computed_run(kSource / "data/phantom/knee.toml");
  return run;
}

/// Three poses of it, at 20, 25 and 30 degrees: enough to damage the middle one.
inline Run phantom_poses() {
  Run run = phantom_run();
  run.sweep.poses = {run.sweep.poses.at(4), run.sweep.poses.at(5), run.sweep.poses.at(6)};
  return run;
}

}  // namespace condyle::test
