#include "condyle/compare/compare.h"
#include "condyle/app/tell.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "condyle/app/begin_study.h"
#include "condyle/app/commands.h"
#include "condyle/app/kept_pieces.h"
#include "condyle/app/progress.h"
#include "condyle/app/range_options.h"
#include "condyle/app/reference_options.h"
#include "condyle/app/summary.h"
#include "condyle/app/talk.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/results/make_run.h"
#include "condyle/results/output_file.h"
#include "condyle/results/run_view.h"
#include "condyle/results/sweep_table.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle {
namespace {

struct CompareCommand {
  Talk talk;
  std::string scene, output;
  RangeOptions range;
  CompareOptions options;
  bool resume = false;
};

bool has_layers(const Scene& scene) {
  return std::any_of(scene.contacts.begin(), scene.contacts.end(),
                     [](const ContactDescription& contact) { return contact.layer.has_value(); });
}

int run_compare(const CompareCommand& command) {
  const Talk& talk = command.talk;
  CommandClock clock;
  check_output_file(command.output, ".h5");
  Scene scene = read_scene(command.scene);
  refuse_to_overwrite_inputs(command.output, scene);
  check_journal_file(command.output, scene, kCompareJournal);
  override_range(command.scene, command.range, scene);
  check_compared_scene(scene);
  const std::vector<InputFile> meshes = mesh_files(scene);
  const std::vector<FittedSurface> surfaces = fit_aloud(talk, scene);
  Run run = make_run(scene, surfaces);
  expect_same(meshes, run.inputs);
  tell_warnings(talk, run);
  KeptPieces kept(talk, command.output, command.resume, kCompareJournal,
                  comparison_parts(scene, surfaces, command.options), scene);
  run.sweep =
      kept.keeping().get(static_cast<int>(Variant::kOurs), [&] { return sweep(scene, surfaces); });
  const SweepResult& ours = run.sweep;
  Progress progress(talk, "sweeps");
  const auto comparison = std::make_shared<const Comparison>(compare(
      scene, surfaces, ours, command.options,
      [&](int done, int total) { progress.at(done, total); }, kept.keeping()));
  run.study = comparison;
  progress.clear();
  if (has_layers(scene))
    say(talk, "the reference and the steps to it have rigid contacts, ours elastic layers\n");
  for (const std::string& line : summary_lines(scene, surfaces, ours, *comparison))
    say(talk, "{}\n", line);
  kept.write_result(talk, command.output, run);
  const SweptQuantity swept = swept_quantity(run);
  for (const std::string& line : failures(swept, ours)) tell(stderr, "condyle: {}\n", line);
  for (const std::string& line : failures(swept, comparison->reference))
    tell(stderr, "condyle: reference: {}\n", line);
  const auto all = static_cast<int>(ours.poses.size());
  const bool both = ours.count_converged() == all && comparison->reference.count_converged() == all;
  CommandSummary facts = clock.summary(talk, command.output, both ? 0 : kSomePoseFailed);
  tell_journal_failure(kept.journal(), facts);
  return finish(talk, facts, run);
}

}  // namespace

void setup_compare(CLI::App& program, int& status) {
  const auto options = std::make_shared<CompareCommand>();
  CLI::App* command = program.add_subcommand(
      "compare", "Set Wismans' model of the same specimen beside ours, over the scene's sweep");
  command
      ->add_option("SCENE", options->scene, "scene file (TOML); condyle report compares two runs")
      ->required();
  command->add_option("-o,--output", options->output, "result file to write (HDF5)")->required();
  add_range_options(*command, options->range);
  add_reference_options(*command, options->options);
  add_resume_option(*command, options->resume);
  add_talk_options(*command, options->talk);
  command->footer("Example: condyle compare data/wismans-type/knee.toml -o out/compare.h5");
  command->callback([options, &status] {
    status = run_telling_errors(options->talk, [&] { return run_compare(*options); });
  });
}

}  // namespace condyle
