#include "condyle/compare/laxity.h"
#include "condyle/app/tell.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>

#include "condyle/app/begin_study.h"
#include "condyle/app/commands.h"
#include "condyle/app/kept_pieces.h"
#include "condyle/app/progress.h"
#include "condyle/app/reference_options.h"
#include "condyle/app/summary.h"
#include "condyle/app/talk.h"
#include "condyle/math/degree.h"
#include "condyle/results/run_view.h"
#include "condyle/results/sweep_table.h"

namespace condyle {
namespace {

struct LaxityCommand {
  Talk talk;
  std::string scene, output;
  CompareOptions options;
  bool resume = false;
};

int report_failures(const SweptQuantity& swept, const LaxityResult& result) {
  int status = 0;
  const auto report = [&](const LaxityCurve& curve, const SweepResult& sweep, const char* model) {
    for (const std::string& line : failures(swept, sweep)) {
      tell(stderr, "condyle: {} deg, {}{}: {}\n", std::round(1e6 * curve.flexion / kDegree) / 1e6,
           curve.cut ? "cut" : "intact", model, line);
      status = kSomePoseFailed;
    }
  };
  for (const LaxityCurve& curve : result.curves) {
    report(curve, curve.ours, "");
    if (curve.reference) report(curve, *curve.reference, ", reference");
  }
  return status;
}

int run_laxity(const LaxityCommand& command) {
  const Talk& talk = command.talk;
  CommandClock clock;
  auto [scene, surfaces, run] =
      begin_study(talk, command.scene, command.output, [&](const Scene& s) {
        check_laxity_scene(s);
        check_journal_file(command.output, s, kLaxityJournal);
      });
  KeptPieces kept(talk, command.output, command.resume, kLaxityJournal,
                  comparison_parts(scene, surfaces, command.options), scene);
  Progress progress(talk, "curves");
  const auto laxity = std::make_shared<const LaxityResult>(test_laxity(
      scene, surfaces, command.options, [&](int done, int total) { progress.at(done, total); },
      kept.keeping()));
  run.study = laxity;
  progress.clear();
  for (const std::string& line : laxity_lines(scene, *laxity)) say(talk, "{}\n", line);
  kept.write_result(talk, command.output, run);
  const int status = report_failures(swept_quantity(run), *laxity);
  CommandSummary facts = clock.summary(talk, command.output, status);
  tell_journal_failure(kept.journal(), facts);
  return finish(talk, facts, run);
}

}  // namespace

void setup_laxity(CLI::App& program, int& status) {
  const auto options = std::make_shared<LaxityCommand>();
  CLI::App* command = program.add_subcommand(
      "laxity", "Vary a load at several angles of flexion, with and without some ligaments");
  command->add_option("SCENE", options->scene, "scene file (TOML) with [laxity]")->required();
  command->add_option("-o,--output", options->output, "result file to write (HDF5)")->required();
  add_reference_options(*command, options->options);
  add_resume_option(*command, options->resume);
  add_talk_options(*command, options->talk);
  command->footer("Example: condyle laxity data/wismans-type/drawer.toml -o out/laxity.h5");
  command->callback([options, &status] {
    status = run_telling_errors(options->talk, [&] { return run_laxity(*options); });
  });
}

}  // namespace condyle
