#include "condyle/app/resume.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <utility>

#include "condyle/app/tell.h"
#include "condyle/input_error.h"
#include "condyle/results/make_run.h"

namespace condyle {
namespace {

std::vector<KnownPose> poses_of_run(const std::filesystem::path& output,
                                    const Scene& scene,
                                    const std::vector<FittedSurface>& surfaces) {
  std::error_code unknown;
  if (!std::filesystem::exists(output, unknown)) return {};
  const Run run = read_run(output);
  if (run.kind() != RunKind::kSweep)
    throw InputError(output.string() + ": is no sweep, expected the result of condyle sweep");
  expect_same_scene(output.string(), run, scene, surfaces);
  return known_poses(run.sweep);
}

std::string could_be_resumed(const std::string& journal, const std::string& amount) {
  return fmt::format(
      "{} holds {} of a run that was stopped: --resume would have gone on with it, this run starts "
      "anew",
      journal, amount);
}

std::string nothing_to_resume(const std::filesystem::path& output) {
  return fmt::format("nothing to resume from in {}, starting anew", output.string());
}

}  // namespace

EarlierPoses earlier_poses(const std::filesystem::path& output,
                           bool resume,
                           const Scene& scene,
                           const std::vector<FittedSurface>& surfaces) {
  const std::string file = journal_path(output).string();
  JournalContents journal = read_journal(file, scene);
  const std::size_t in_journal = journal.poses.size();
  const RunIdentity here = identity(scene, surfaces);
  EarlierPoses earlier;
  if (!resume) {
    if (in_journal > 0 && journal.identity == here) {
      earlier.message = could_be_resumed(file, fmt::format("{} poses", in_journal));
    }
    return earlier;
  }
  if (journal.started)
    expect_same_parts(file, {{journal.identity.scene, journal.identity.surfaces}},
                      run_parts(here, scene));
  earlier.poses = poses_of_run(output, scene, surfaces);
  const std::size_t in_run = earlier.poses.size();
  earlier.journal_bytes = journal.whole_bytes;
  earlier.poses.insert(earlier.poses.end(), std::make_move_iterator(journal.poses.begin()),
                       std::make_move_iterator(journal.poses.end()));
  earlier.message = earlier.poses.empty()
                        ? nothing_to_resume(output)
                        : fmt::format("resuming with {} poses of {} and {} of its journal", in_run,
                                      output.string(), in_journal);
  return earlier;
}

void say_what_is_resumed(const Talk& talk,
                         const std::filesystem::path& output,
                         bool resume,
                         const std::optional<JournalHead>& head,
                         const JournalParts& parts,
                         const std::string& amount) {
  const std::string file = journal_path(output).string();
  if (resume) {
    if (head) expect_same_parts(file, *head, parts);
    say(talk, "{}\n\n",
        amount.empty() ? nothing_to_resume(output)
                       : fmt::format("resuming with {} of {}", amount, file));
  } else if (!amount.empty() && head && same_parts(*head, parts)) {
    say(talk, "{}\n\n", could_be_resumed(file, amount));
  }
}

void add_resume_option(CLI::App& command, bool& resume) {
  command.add_flag("--resume", resume, "go on from the journal of a stopped run");
}

void check_journal_file(const std::filesystem::path& output,
                        const Scene& scene,
                        const JournalKind& kind) {
  refuse_to_overwrite_inputs(journal_path(output), scene);
  expect_journal(journal_path(output), kind);
}

std::string last_words(const std::filesystem::path& output, const std::string& pieces) {
  return fmt::format("{} holds its {}, --resume goes on with them", journal_path(output).string(),
                     pieces);
}

void write_and_end_journal(const Talk& talk,
                           const std::string& output,
                           const Run& run,
                           JournalLines& journal,
                           const std::string& pieces) {
  try {
    write_run(output, run);
  } catch (const InputError& error) {
    std::error_code unknown;
    if (!journal.failure().empty() || !std::filesystem::exists(journal_path(output), unknown))
      throw;
    throw InputError(fmt::format("{} (its {} are in {}: --resume takes them over)", error.what(),
                                 pieces, journal_path(output).string()));
  }
  journal.remove();
  say(talk, "wrote {}\n", output);
  std::fflush(stdout);
}

void tell_journal_failure(const JournalLines& journal, CommandSummary& facts) {
  if (journal.failure().empty()) return;
  tell(stderr, "condyle: {}\n", journal.failure());
  facts.warnings.push_back(journal.failure());
}

}  // namespace condyle
