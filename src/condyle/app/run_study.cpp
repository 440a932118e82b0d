#include "condyle/app/run_study.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>
#include <utility>

#include "condyle/app/commands.h"
#include "condyle/app/interrupt.h"
#include "condyle/app/progress.h"
#include "condyle/app/study_endings.h"
#include "condyle/app/study_inputs.h"
#include "condyle/input_error.h"
#include "condyle/results/study_file.h"
#include "condyle/study/study_worker.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

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
  const auto between = [&] {
    work.team.between();
    const std::uint64_t far = work.team.size > 1 ? begun : done;
    progress.at(samples_of_chunks(std::min<std::uint64_t>(far, missing.size())),
                samples_of_chunks(missing.size()));
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

}  // namespace

int run_study(const StudyCommand& command, const StudyTeam& team) {
  StudyWork work{command, team};
  work.plan = ready_study(command);
  team.expect_same(study_identity(work.plan));
  for (const std::string& line : plan_lines(work.plan)) say(command.talk, "{}\n", line);
  if (command.resume && team.any(team.first() && is_complete(work))) {
    if (!team.first()) return 0;
    expect_no_table(work);
    work.models = study_models(work.plan);  // whose own sweeps fail is told again
    return complete_already(work);
  }
  auto journals = std::make_unique<StudyJournals>(open_journals(work));
  const LastWords words(fmt::format("{} holds the chunks that are done, --resume goes on with them",
                                    work.folder().string()));
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
