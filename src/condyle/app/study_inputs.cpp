#include "condyle/app/study_inputs.h"

#include <fmt/format.h>

#include "condyle/app/begin_study.h"
#include "condyle/app/files_to_write.h"
#include "condyle/app/progress.h"
#include "condyle/input_error.h"
#include "condyle/results/output_file.h"
#include "condyle/scene_file/read_study.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

void check_study_options(const StudyCommand& command) {
  const auto refuse = [](const char* what) { throw InputError(what); };
  if (command.merge && !command.part.whole())
    refuse("--merge and --part: expected one of them (parts first, then --merge)");
  if (command.merge && command.resume)
    refuse("--merge and --resume: expected one of them (--resume computes what --merge misses)");
  const bool tables = !command.bands.empty() || !command.indices.empty() || !command.table.empty();
  if (tables && !command.part.whole())
    refuse("--part writes no tables, expected --bands, --indices and --table with --merge");
}

std::vector<FileToWrite> study_files_to_write(const StudyCommand& command) {
  return given_files({{command.output, ".h5"},
                      {command.bands, ".csv"},
                      {command.indices, ".csv"},
                      {command.table, ".csv"}});
}

void check_study_files(const StudyCommand& command, const ReadStudy& read) {
  const std::vector<FileToWrite> files = study_files_to_write(command);
  for (const FileToWrite& file : files) {
    refuse_to_overwrite(file.path, {read.study.file, read.study.table});
    for (const Scene& scene : read.scenes) refuse_to_overwrite_inputs(file.path, scene);
  }
  check_files_to_write(files);
}

void change_as_asked(const StudyCommand& command, StudyDescription& study) {
  if (command.seed) study.seed = *command.seed;
  if (!command.samples) return;
  if (study.design == DesignKind::kGrid)
    throw InputError(
        fmt::format("--samples {}: the design of {} is a grid, expected levels in that file",
                    *command.samples, study.file.string()));
  study.samples = *command.samples;
}

}  // namespace

StudyPlan ready_study(const StudyCommand& command) {
  check_study_options(command);
  check_output_file(command.output, ".h5");
  ReadStudy read = read_study(command.study);
  change_as_asked(command, read.study);
  check_study_files(command, read);
  say(command.talk, "{}\n\n", read.study.title);
  Progress progress(command.talk, "knees");
  return study_plan(std::move(read), [&](int done, int total) { progress.at(done, total); });
}

std::vector<std::string> plan_lines(const StudyPlan& plan) {
  const std::size_t knees = plan.knees.size(), poses = plan.values.size();
  std::string line =
      fmt::format("{} {}, {} {} that {}, {} samples", knees, knees == 1 ? "knee" : "knees",
                  plan.parameters.size(), plan.parameters.size() == 1 ? "number" : "numbers",
                  plan.parameters.size() == 1 ? "varies" : "vary", plan.samples());
  line += fmt::format(" of {} {}, {} kept of each pose", poses, poses == 1 ? "pose" : "poses",
                      plan.outputs.size());
  return {line};
}

}  // namespace condyle
