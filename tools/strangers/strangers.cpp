/// condyle_strangers: how the program fares on knees that it was not tuned to. Runs the program on
/// them, verifies every pose, and writes docs/strangers.md with each figure beside the one wanted.
///
///   condyle_strangers PROGRAM SOURCE -o PAGE.md [--quick] [--sweeps N] [--threads N]
///   [--parts known,steps,...]

#include <fmt/format.h>

#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include "condyle/start_threads.h"
#include "strangers/stranger_parts.h"

namespace condyle::strangers {
namespace {

namespace fs = std::filesystem;

int run(int argc, char** argv) {
  CLI::App app{"Knees that condyle was not tuned to"};
  Study study;
  fs::path output;
  std::vector<std::string> parts;
  study.threads = thread_count(0);
  app.add_option("PROGRAM", study.program, "condyle")->required()->check(CLI::ExistingFile);
  app.add_option("SOURCE", study.source, "the project's folder")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("-o,--output", output, "page to write (Markdown)")->required();
  app.add_flag("--quick", study.quick, "a small selection");
  app.add_option("--sweeps", study.rough_sweeps, "of rough bone, at least")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--threads", study.threads, "sweeps at a time")->capture_default_str();
  app.add_option("--parts", parts,
                 "of known, steps, places, roughness, time; all where none is named")
      ->delimiter(',')
      ->check(CLI::IsMember({"known", "steps", "places", "roughness", "time"}));
  CLI11_PARSE(app, argc, argv);
  study.scratch = fs::temp_directory_path() / fmt::format("condyle_strangers_{}", ::getpid());
  find_knees(study);
  study.write(
      "# Strangers\n\nMade by `tools/strangers.sh`: knees that the program was not tuned to, swept "
      "by `condyle "
      "sweep`, every converged pose checked by `condyle verify` (docs/verify.md).");
  if (study.quick) study.write("\nA quick selection (`--quick`), not the whole study.");
  if (study.rough_sweeps != Study{}.rough_sweeps)
    study.write(fmt::format("\nOf rough bone a selection (`--sweeps {}`); the whole has 2000.",
                            study.rough_sweeps));
  for (const std::string& name : study.absent) {
    study.write(fmt::format("\nNot here, and left out: {}.", name));
    fmt::print(stderr, "not here, and left out: {}\n", name);
  }
  const auto wanted = [&](const char* part) {
    return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  if (wanted("known")) study_known(study);
  if (wanted("steps")) study_steps(study);
  if (wanted("places")) study_places(study);
  if (wanted("roughness")) study_roughness(study);
  if (wanted("time")) study_time(study);
  fs::remove_all(study.scratch);
  fmt::print("{}", study.page);
  std::ofstream(output) << study.page;
  return study.met ? 0 : 2;
}

}  // namespace
}  // namespace condyle::strangers

int main(int argc, char** argv) {
  try {
    return condyle::strangers::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "condyle_strangers: %s\n", error.what());
    return 1;
  }
}
