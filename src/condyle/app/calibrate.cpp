#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "condyle/app/begin_study.h"
#include "condyle/app/commands.h"
#include "condyle/app/files_to_write.h"
#include "condyle/app/interrupt.h"
#include "condyle/app/progress.h"
#include "condyle/app/resume.h"
#include "condyle/app/summary.h"
#include "condyle/app/talk.h"
#include "condyle/app/tell.h"
#include "condyle/calibration/calibration_words.h"
#include "condyle/calibration/free_parameter.h"
#include "condyle/input_error.h"
#include "condyle/results/calibration_journal.h"
#include "condyle/results/journal.h"
#include "condyle/results/output_file.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

constexpr int kNoWholeFit = 2;

struct CalibrateCommand {
  Talk talk;
  std::string scene, output;
  std::string fitted_scene, table, latex, posterior;  ///< empty: not asked for
  std::optional<int> starts, samples;
  std::optional<unsigned> seed;
  bool suggest = false, resume = false;
};

std::vector<FileToWrite> files_to_write(const CalibrateCommand& command) {
  return given_files({{command.output, ".h5"},
                      {journal_path(command.output), ""},
                      {command.fitted_scene, ".toml"},
                      {command.table, ".csv"},
                      {command.latex, ".tex"},
                      {command.posterior, ".csv"}});
}

/// Each file to write is one of its own, can be written, and is none that is read.
void check_files(const CalibrateCommand& command, const Scene& scene) {
  const std::vector<FileToWrite> files = files_to_write(command);
  for (const FileToWrite& file : files) refuse_to_overwrite_inputs(file.path, scene);
  check_files_to_write(files);
  expect_calibration_journal(journal_path(command.output));
}

/// The text says of such a wrap that it is to be fitted, and reading it fits it to insertions that have moved; the
/// calibration kept the one of the scene.
void warn_of_wraps(const CalibrateCommand& command, const Scene& scene, const Scene& changed) {
  if (command.talk.quiet) return;
  for (const WrapDescription& wrap : scene.wraps) {
    const bool moved =
        wrap.fit &&
        std::any_of(wrap.fit->ligaments.begin(), wrap.fit->ligaments.end(), [&](int index) {
          const auto i = static_cast<std::size_t>(index);
          const auto &was = scene.ligaments[i].ends, &is = changed.ligaments[i].ends;
          return was[0].at != is[0].at || was[1].at != is[1].at;
        });
    if (moved)
      tell(stderr,
           "condyle: warning: wrap \"{}\" is fitted anew where {} is read, as insertions of its "
           "ligaments are free: "
           "poses there differ a little from those of the calibration\n",
           wrap.name, command.fitted_scene);
  }
}

/// Before the long work: every number that may change has a place in the text.
void check_text(const CalibrateCommand& command,
                const Scene& scene,
                const MeasurementTable& table,
                const std::vector<TriangleMesh>& meshes) {
  if (command.fitted_scene.empty()) return;
  constexpr double kSomeChange = 1e-3;
  CalibrationResult changed;
  changed.table = table;
  changed.parameters = free_parameters(scene, meshes, changed.table);
  changed.fit.theta =
      Eigen::VectorXd::Constant(static_cast<Eigen::Index>(changed.parameters.size()), kSomeChange);
  (void)fitted_scene_text(scene, changed, command.fitted_scene);
  const Eigen::VectorXd& theta = changed.fit.theta;
  warn_of_wraps(command, scene,
                scene_with(scene, changed.parameters, {theta.begin(), theta.end()}));
}

/// What a journal holds of an earlier run, and a word about it.
CalibrationContents earlier_numbers(const CalibrateCommand& command,
                                    const CalibrationIdentity& identity,
                                    const Scene& scene) {
  const fs::path file = journal_path(command.output);
  if (!command.resume) {
    std::error_code unknown;
    if (fs::file_size(file, unknown) > 0)
      say(command.talk,
          "{} is of a run that was stopped: --resume would have gone on with it, this run starts "
          "anew\n\n",
          file.string());
    return {};
  }
  CalibrationContents journal = read_calibration_journal(file, identity, scene);
  say(command.talk, "{} {}\n\n",
      journal.best ? "going on from the best numbers of"
                   : "nothing to resume from, starting anew: no",
      file.string());
  return journal;
}

/// One progress line for each stage of the work.
class Stages {
 public:
  explicit Stages(const Talk& talk) : talk_(talk) {}
  void at(const std::string& stage, int done, int total) {
    if (!line_ || stage != stage_) {
      line_.reset();
      line_.emplace(talk_, stage);
      stage_ = stage;
    }
    line_->at(done, total);
  }

 private:
  const Talk& talk_;
  std::string stage_;
  std::optional<Progress> line_;
};

CalibrationResult calibrate_aloud(const CalibrateCommand& command,
                                  const Scene& scene,
                                  const std::vector<FittedSurface>& surfaces,
                                  const MeasurementTable& table,
                                  const std::vector<TriangleMesh>& meshes,
                                  const std::optional<Eigen::VectorXd>& from,
                                  CalibrationJournal& journal) {
  const Interrupt interrupt;
  Stages stages(command.talk);
  CalibrationOptions options;
  options.suggest = command.suggest;
  options.starts = command.starts;
  options.samples = command.samples;
  options.from = from;
  options.on_progress = [&](const std::string& stage, int done, int total) {
    stages.at(stage, done, total);
    return !interrupt.asked();
  };
  options.on_better = [&](const Eigen::VectorXd& theta, double cost) {
    journal.append(theta, cost);
  };
  return calibrate(scene, surfaces, table, meshes, options);
}

/// A line for each thing that did not succeed.
int report_failures(const CalibrateCommand& command, const CalibrationResult& result) {
  std::vector<std::string> lines;
  if (result.stopped)
    lines.push_back(
        fmt::format("stopped: {} holds the best so far, --resume goes on from it", command.output));
  else if (!result.fit.converged)
    lines.push_back("the fit did not converge: " + result.fit.message);
  for (const Agreement* rows : {&result.fitted, &result.unseen})
    if (rows->lost > 0)
      lines.push_back(
          fmt::format("{} of {} {} rows have no pose", rows->lost, rows->rows, rows->name));
  for (const std::string& line : lines) tell(stderr, "condyle: {}\n", line);
  return lines.empty() ? 0 : kNoWholeFit;
}

/// A fit may move an end to where no scene may have it.
std::string readable_scene(const Scene& scene,
                           const CalibrationResult& result,
                           const fs::path& file) {
  std::string text = fitted_scene_text(scene, result, file);
  try {
    (void)parse_scene(text, file);
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{}: not written, as no scene may have the numbers that were found: {}",
                    file.string(), error.what()));
  }
  return text;
}

std::vector<fs::path> write_tables(const CalibrateCommand& command,
                                   const Scene& scene,
                                   const CalibrationResult& result) {
  std::vector<fs::path> written;
  const auto write = [&](const std::string& file, const auto& text) {
    if (file.empty()) return;
    write_output_file(file, text());
    say(command.talk, "wrote {}\n", file);
    written.emplace_back(file);
  };
  write(command.table, [&] { return parameter_csv(result); });
  write(command.latex, [&] { return parameter_latex(result); });
  write(command.posterior, [&] { return samples_csv(result); });
  write(command.fitted_scene, [&] { return readable_scene(scene, result, command.fitted_scene); });
  return written;
}

int run_calibrate(const CalibrateCommand& command) {
  const Talk& talk = command.talk;
  CommandClock clock;
  MeasurementTable table;
  auto [scene, surfaces, run] =
      begin_study(talk, command.scene, command.output, [&](const Scene& s) {
        if (!s.calibration)
          throw InputError(s.file.string() +
                           ": [calibrate] is missing, expected the table of measurements");
        check_files(command, s);
        if (!command.posterior.empty() && command.samples.value_or(s.calibration->samples) == 0)
          throw InputError("--posterior " + command.posterior +
                           ": there are no samples to write, expected samples > 0 in [calibrate] "
                           "or by --samples");
        table = read_measurements(s);  // before the surfaces are fitted
        if (!talk.quiet)
          for (const std::string& warning : table.warnings)
            tell(stderr, "condyle: warning: {}\n", warning);
      });
  if (command.seed) scene.calibration->seed = *command.seed;
  const std::vector<TriangleMesh> meshes = body_meshes(scene, surfaces);
  check_text(command, scene, table, meshes);
  const CalibrationIdentity identity = calibration_identity(scene, surfaces);
  LineFile journal_file(journal_path(command.output), command.output);
  const CalibrationContents earlier = earlier_numbers(command, identity, scene);
  CalibrationJournal journal(journal_file, identity, earlier.whole_bytes);
  const LastWords words(fmt::format("{} holds the best numbers so far, --resume goes on with them",
                                    journal_path(command.output).string()));
  const auto result = std::make_shared<const CalibrationResult>(
      calibrate_aloud(command, scene, surfaces, table, meshes, earlier.best, journal));
  run.study = result;
  for (const std::string& line : calibration_lines(scene, *result)) say(talk, "{}\n", line);
  say(talk, "\n");
  write_run(command.output, run);
  say(talk, "wrote {}\n", command.output);
  const std::vector<fs::path> files = write_tables(command, scene, *result);
  if (!result->stopped) journal.remove();
  const int status = report_failures(command, *result);
  CommandSummary facts = clock.summary(talk, command.output, status);
  facts.files = files;
  tell_journal_failure(journal, facts);
  return finish(talk, facts, run);
}

void add_outputs(CLI::App& command, CalibrateCommand& options) {
  command.add_option("-o,--output", options.output, "result file to write (HDF5)")->required();
  command.add_option("--scene", options.fitted_scene, "the scene with the fitted numbers (TOML)");
  command.add_option("--table", options.table, "table of the numbers (CSV)");
  command.add_option("--latex", options.latex, "table of the numbers (LaTeX)");
  command.add_option("--posterior", options.posterior, "samples of the posterior (CSV)");
}

}  // namespace

void setup_calibrate(CLI::App& program, int& status) {
  const auto options = std::make_shared<CalibrateCommand>();
  CLI::App* command = program.add_subcommand(
      "calibrate", "Fit numbers of the knee to measurements, and say what these determine");
  command->add_option("SCENE", options->scene, "scene file (TOML) with [calibrate]")->required();
  add_outputs(*command, *options);
  command->add_flag("--suggest", options->suggest, "rank tests that were not made");
  command->add_option("--starts", options->starts, "starts of the search, in place of the scene's")
      ->check(CLI::Range(1, 1000000));
  command->add_option("--samples", options->samples, "of the posterior, in place of the scene's")
      ->check(CLI::Range(0, 1000000));
  command->add_option("--seed", options->seed, "of all random numbers, in place of the scene's");
  command->add_flag("--resume", options->resume, "go on from the journal of a stopped run");
  add_talk_options(*command, options->talk);
  command->footer(
      "Example: condyle calibrate knee.toml -o out/knee.fit.h5 --scene knee.fitted.toml");
  command->callback([options, &status] {
    status = run_telling_errors(options->talk, [&] { return run_calibrate(*options); });
  });
}

}  // namespace condyle
