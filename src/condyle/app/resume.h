#pragma once

/// What earlier runs left for a command to go on from: the journal of a run that was stopped, and for a
/// sweep the result file too; and how a command with a journal ends.

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/app/summary.h"
#include "condyle/equilibrium/known_poses.h"
#include "condyle/results/journal.h"

namespace CLI {
class App;
}

namespace condyle {

struct EarlierPoses {
  std::vector<KnownPose> poses;
  std::size_t journal_bytes = 0;  ///< of the journal that are to be kept
  std::string message;            ///< one line for the user; may be empty
};

/// With `resume` the poses of `output` and of its journal, else none, and a word where a stopped
/// run could be resumed. Throws InputError where they belong to another scene or other surfaces.
[[nodiscard]] EarlierPoses earlier_poses(const std::filesystem::path& output,
                                         bool resume,
                                         const Scene& scene,
                                         const std::vector<FittedSurface>& surfaces);

/// Says what is taken over of the journal of `output`, `amount` of it ("3 sweeps", or empty where it
/// holds nothing), or that a stopped run could be resumed. Throws InputError where it is to be resumed
/// and belongs to other parts.
void say_what_is_resumed(const Talk& talk,
                         const std::filesystem::path& output,
                         bool resume,
                         const std::optional<JournalHead>& head,
                         const JournalParts& parts,
                         const std::string& amount);

/// `--resume` of a command that goes on from its journal alone.
void add_resume_option(CLI::App& command, bool& resume);

/// Throws InputError where the journal of `output` is an input of the scene or something else than a
/// journal of that kind: before any work.
void check_journal_file(const std::filesystem::path& output,
                        const Scene& scene,
                        const JournalKind& kind);

/// What a signal says of a journal: for LastWords, as soon as it holds any of the `pieces`.
[[nodiscard]] std::string last_words(const std::filesystem::path& output,
                                     const std::string& pieces);

/// Writes the result, whose `pieces` ("poses") the journal holds, and removes the journal; it stays where
/// the result cannot be written.
void write_and_end_journal(const Talk& talk,
                           const std::string& output,
                           const Run& run,
                           JournalLines& journal,
                           const std::string& pieces);

/// A line, and a warning for scripts, where a journal could not be written.
void tell_journal_failure(const JournalLines& journal, CommandSummary& facts);

}  // namespace condyle
