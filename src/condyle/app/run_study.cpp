#include "condyle/app/run_study.h"

#include <algorithm>
#include <atomic>
#include <climits>
#include <cstdio>
#include <memory>
#include <thread>
#include <utility>

#include "condyle/app/commands.h"
#include "condyle/app/interrupt.h"
#include "condyle/app/progress.h"
#include "condyle/app/study_inputs.h"
#include "condyle/app/summary.h"
#include "condyle/input_error.h"
#include "condyle/report/study_json.h"
#include "condyle/results/output_file.h"
#include "condyle/results/study_file.h"
#include "condyle/results/study_tables.h"
#include "condyle/results/study_words.h"
#include "condyle/study/study_worker.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

/// A study that is being computed.
struct StudyWork {
  const StudyCommand& command;
  const StudyTeam& team;
  CommandClock clock = {};
  StudyPlan plan = {};
  std::shared_ptr<const StudyModels> models = {};

  [[nodiscard]] const Talk& talk() const { return command.talk; }
  [[nodiscard]] fs::path folder() const { return StudyJournals::folder(command.output); }
  [[nodiscard]] int threads() const {
    return command.threads > 0 ? command.threads
                               : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  }
};

bool holds_chunks(const fs::path& folder) {
  std::error_code unknown;
  for (const auto& entry : fs::directory_iterator(folder, unknown))
    if (entry.path().extension() == ".chunks") return true;
  return false;
}

/// A word about what an earlier run left.
std::string word_of_earlier(const StudyWork& work, bool there, const StudyJournals& journals) {
  const std::string folder = work.folder().string();
  if (work.command.merge) return "";
  if (work.command.resume)
    return journals.count() > 0
               ? fmt::format("going on with {} of {} chunks in {}", journals.count(),
                             chunk_count(work.plan), folder)
               : fmt::format("nothing to resume from in {}, starting anew", folder);
  return there && work.command.part.whole()
             ? fmt::format(
                   "{} held chunks of a run that was stopped: --resume would have gone on with "
                   "it, this run starts anew",
                   folder)
             : "";
}

/// Of the first process of a team: takes the folder.
StudyJournals take_folder(const StudyWork& work) {
  expect_room(work.command.output, work.plan);
  const bool there = holds_chunks(work.folder());
  StudyJournals journals(work.command.output, work.plan, work.command.part,
                         work.command.resume || work.command.merge);
  const std::string word = word_of_earlier(work, there, journals);
  if (!word.empty()) say(work.talk(), "{}\n", word);
  return journals;
}

StudyJournals open_journals(const StudyWork& work) {
  if (work.team.first()) {
    StudyJournals journals = take_folder(work);
    work.team.barrier();
    return journals;
  }
  work.team.barrier();
  return StudyJournals::join(work.command.output, work.plan);
}

/// False where it was stopped.
bool compute_chunks(const StudyWork& work, StudyJournals& journals) {
  const Interrupt interrupt;
  const std::vector<std::uint64_t> missing = journals.missing();
  const NextChunk given = work.team.share(missing);
  Progress progress(work.talk(), "samples");
  // Chunks are given in order: the last one tells how far all processes are.
  std::atomic<std::uint64_t> begun = 0, done = 0;
  const NextChunk next = [&] {
    const std::optional<std::uint64_t> chunk = given();
    if (chunk)
      begun = static_cast<std::uint64_t>(std::lower_bound(missing.begin(), missing.end(), *chunk) -
                                         missing.begin());
    return chunk;
  };
  const KeepChunk keep = [&](int worker, const StudyChunk& chunk) {
    journals.append(worker, chunk);
    ++done;
    return !interrupt.asked();
  };
  const auto samples = [](std::uint64_t chunks) {
    return static_cast<int>(std::min<std::uint64_t>(chunks * kChunkSamples, INT_MAX));
  };
  const auto between = [&] {
    work.team.between();
    progress.at(samples(std::min<std::uint64_t>(work.team.size > 1 ? begun : done, missing.size())),
                samples(missing.size()));
    return !interrupt.asked();
  };
  return run_chunks(work.plan, work.models, work.threads(), next, keep, between) &&
         !interrupt.asked();
}

/// Throws InputError that names what parts left out.
void expect_all_chunks(const StudyWork& work, StudyJournals& journals) {
  const std::vector<std::uint64_t> missing = journals.missing();
  if (missing.empty()) return;
  const std::uint64_t first = missing.front() * kChunkSamples;
  const std::string message = fmt::format(
      "{}: {} of {} chunks are missing (the first: samples {} to {}), expected all of them: parts "
      "that were stopped go on with --part i/n --resume",
      work.folder().string(), missing.size(), chunk_count(work.plan), first,
      std::min(first + kChunkSamples, work.plan.samples()) - 1);
  if (journals.count() == 0) journals.remove();
  throw InputError(message);
}

/// Says that it was stopped.
int stopped_study(const StudyWork& work, const StudyJournals& journals) {
  CommandSummary facts = work.clock.summary(work.talk(), "", kSomePoseFailed);
  const std::string line =
      fmt::format("stopped: {} holds {} of {} chunks, --resume goes on from there",
                  work.folder().string(), journals.count(), chunk_count(work.plan));
  fmt::print(stderr, "condyle: {}\n", line);
  facts.warnings.push_back(line);
  if (work.talk().json)
    fmt::print("{}\n", json_part_of_study(facts, journals.count(), chunk_count(work.plan)));
  return facts.exit_code;
}

int finished_part(const StudyWork& work, const StudyJournals& journals) {
  const CommandSummary facts = work.clock.summary(work.talk(), "", 0);
  say(work.talk(), "part {}/{} is done: {} of {} chunks in {}; --merge when all parts are\n",
      work.command.part.i, work.command.part.n, journals.count(), chunk_count(work.plan),
      work.folder().string());
  if (work.talk().json)
    fmt::print("{}\n", json_part_of_study(facts, journals.count(), chunk_count(work.plan)));
  return 0;
}

/// A line for each knee whose own sweep fails somewhere.
std::vector<std::string> nominal_failures(const StudyWork& work) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < work.plan.knees.size(); ++k) {
    const SweepResult& sweep = nominal_sweep(*work.models, k);
    const auto poses = static_cast<int>(sweep.poses.size());
    if (sweep.count_converged() < poses)
      lines.push_back(fmt::format("{}: {} of {} poses of the knee's own sweep did not converge",
                                  work.plan.knees[k].scene.file.string(),
                                  poses - sweep.count_converged(), poses));
  }
  return lines;
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

std::vector<fs::path> write_study_tables(const StudyWork& work,
                                         const StudyView& view,
                                         const StudyJournals& journals) {
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
  if (!command.table.empty()) {
    write_sample_table(command.table, work.plan, journals);
    wrote(command.table);
  }
  return written;
}

int finished_study(const StudyWork& work, StudyJournals& journals) {
  write_result(work, journals);
  const StudyView view = read_study_file(work.command.output);
  for (const std::string& line : study_lines(view)) say(work.talk(), "{}\n", line);
  say(work.talk(), "\nwrote {}\n", work.command.output);
  const std::vector<fs::path> files = write_study_tables(work, view, journals);
  journals.remove();
  const std::vector<std::string> failures = nominal_failures(work);
  for (const std::string& line : failures) fmt::print(stderr, "condyle: {}\n", line);
  CommandSummary facts =
      work.clock.summary(work.talk(), work.command.output, failures.empty() ? 0 : kSomePoseFailed);
  facts.files = files;
  facts.warnings = failures;
  if (work.talk().json) fmt::print("{}\n", json_study(facts, view));
  return facts.exit_code;
}

}  // namespace

int run_study(const StudyCommand& command, const StudyTeam& team) {
  StudyWork work{command, team};
  work.plan = ready_study(command);
  team.expect_same(study_identity(work.plan));
  for (const std::string& line : plan_lines(work.plan)) say(command.talk, "{}\n", line);
  auto journals = std::make_unique<StudyJournals>(open_journals(work));
  if (command.merge) expect_all_chunks(work, *journals);
  work.models = study_models(work.plan);
  const bool stopped = team.any(!compute_chunks(work, *journals));
  if (!team.first()) journals.reset();
  team.barrier();
  if (!team.first()) return stopped ? kSomePoseFailed : 0;
  journals->read_again();
  if (stopped || !journals->missing().empty()) return stopped_study(work, *journals);
  return command.part.whole() ? finished_study(work, *journals) : finished_part(work, *journals);
}

}  // namespace condyle
