#include "condyle/app/study_endings.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "condyle/app/commands.h"
#include "condyle/app/progress.h"
#include "condyle/app/tell.h"
#include "condyle/input_error.h"
#include "condyle/report/study_json.h"
#include "condyle/results/output_file.h"
#include "condyle/results/study_file.h"
#include "condyle/results/study_tables.h"
#include "condyle/results/study_words.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

/// A line for each knee whose own sweep fails somewhere, and one where no sample has a pose.
std::vector<std::string> failures_of(const StudyWork& work, const StudyView& view) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < work.plan.knees.size(); ++k) {
    const SweepResult& sweep = nominal_sweep(*work.models, k);
    const auto poses = static_cast<int>(sweep.poses.size());
    if (sweep.count_converged() < poses)
      lines.push_back(fmt::format("{}: {} of {} poses of the knee's own sweep did not converge",
                                  work.plan.knees[k].scene.file.string(),
                                  poses - sweep.count_converged(), poses));
  }
  if (view.all.failures.poses > 0 && view.all.failures.failed == view.all.failures.poses)
    lines.emplace_back("no pose of any sample converged");
  return lines;
}

/// What went wrong is told; the exit code says so too.
CommandSummary told(const StudyWork& work, const StudyView& view) {
  const std::vector<std::string> failures = failures_of(work, view);
  for (const std::string& line : failures) tell(stderr, "condyle: {}\n", line);
  CommandSummary facts =
      work.clock.summary(work.talk(), work.command.output, failures.empty() ? 0 : kSomePoseFailed);
  facts.warnings = failures;
  return facts;
}

void write_result(const StudyWork& work, const StudyJournals& journals) {
  std::vector<const SweepResult*> nominal;
  for (std::size_t k = 0; k < work.plan.knees.size(); ++k)
    nominal.push_back(&nominal_sweep(*work.models, k));
  const StudyProvenance provenance{work.clock.summary(work.talk(), "", 0).seconds, work.threads(),
                                   work.team.size};
  Progress progress(work.talk(), "outputs");
  (void)write_study(work.command.output, work.plan, journals, nominal, provenance,
                    [&](int done, int total) { progress.at(done, total); });
}

/// Bands and indices, where they are asked for.
std::vector<fs::path> write_summary_tables(const StudyWork& work, const StudyView& view) {
  std::vector<fs::path> written;
  const auto wrote = [&](const std::string& file) {
    say(work.talk(), "wrote {}\n", file);
    written.emplace_back(file);
  };
  const StudyCommand& command = work.command;
  if (!command.bands.empty()) {
    write_output_file(command.bands, bands_csv(view));
    wrote(command.bands);
  }
  if (!command.indices.empty()) {
    write_output_file(command.indices, indices_csv(view));
    wrote(command.indices);
  }
  return written;
}

std::vector<fs::path> write_study_tables(const StudyWork& work,
                                         const StudyView& view,
                                         const StudyJournals& journals) {
  std::vector<fs::path> written = write_summary_tables(work, view);
  const std::string& table = work.command.table;
  if (table.empty()) return written;
  write_sample_table(table, work.plan, journals);
  say(work.talk(), "wrote {}\n", table);
  written.emplace_back(table);
  return written;
}

}  // namespace

bool holds_chunks(const fs::path& folder) {
  std::error_code unknown;
  for (const auto& entry : fs::directory_iterator(folder, unknown))
    if (entry.path().extension() == ".chunks") return true;
  return false;
}

bool is_complete(const StudyWork& work) {
  return work.command.resume && work.command.part.whole() && !holds_chunks(work.folder()) &&
         holds_study(work.command.output, work.plan);
}

void expect_no_table(const StudyWork& work) {
  if (!work.command.table.empty())
    throw InputError(
        fmt::format("{}: holds all of this study already, expected no --table: it is written from "
                    "samples as they are computed (without --resume)",
                    work.command.output));
}

int complete_already(const StudyWork& work) {
  const StudyView view = read_study_file(work.command.output);
  say(work.talk(), "{} holds all of this study already\n", work.command.output);
  CommandSummary facts = told(work, view);
  facts.files = write_summary_tables(work, view);
  if (work.talk().json) tell("{}\n", json_study(facts, view));
  return facts.exit_code;
}

int stopped_study(const StudyWork& work, const StudyJournals& journals) {
  CommandSummary facts = work.clock.summary(work.talk(), "", kSomePoseFailed);
  const std::string line =
      fmt::format("stopped: {} holds {} of {} chunks, --resume goes on from there",
                  work.folder().string(), journals.count(), chunk_count(work.plan));
  tell(stderr, "condyle: {}\n", line);
  facts.warnings.push_back(line);
  if (work.talk().json)
    tell("{}\n", json_part_of_study(facts, journals.count(), chunk_count(work.plan)));
  return facts.exit_code;
}

int finished_part(const StudyWork& work, const StudyJournals& journals) {
  const CommandSummary facts = work.clock.summary(work.talk(), "", 0);
  say(work.talk(), "part {}/{} is done: {} of {} chunks in {}; --merge when all parts are\n",
      work.command.part.i, work.command.part.n, journals.count(), chunk_count(work.plan),
      work.folder().string());
  if (work.talk().json)
    tell("{}\n", json_part_of_study(facts, journals.count(), chunk_count(work.plan)));
  return 0;
}

int finished_study(const StudyWork& work, StudyJournals& journals) {
  write_result(work, journals);
  const StudyView view = read_study_file(work.command.output);
  for (const std::string& line : study_lines(view)) say(work.talk(), "{}\n", line);
  say(work.talk(), "\nwrote {}\n", work.command.output);
  const std::vector<fs::path> files = write_study_tables(work, view, journals);
  journals.remove();
  CommandSummary facts = told(work, view);
  facts.files = files;
  if (work.talk().json) tell("{}\n", json_study(facts, view));
  return facts.exit_code;
}

}  // namespace condyle
