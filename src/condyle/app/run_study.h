#pragma once

/// What `condyle study` does, for one process with threads and for the ranks of a network alike.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "condyle/app/study_options.h"
#include "condyle/results/study_identity.h"
#include "condyle/study/study_chunk.h"

namespace condyle {

/// The processes that work on one study. Rank 0 takes the folder of journals, says things, merges and
/// writes; the others compute, and append to journals of their own. A process of its own is a team of one.
struct StudyTeam {
  int rank = 0, size = 1;
  /// Throws InputError where what samples depend on differs from that of rank 0. Called once by every
  /// process.
  std::function<void(const StudyIdentity&)> expect_same = [](const StudyIdentity&) {};
  /// Who computes which of the missing chunks. Called once by every process, at the same place; the
  /// list of rank 0 counts.
  std::function<NextChunk(std::vector<std::uint64_t> missing)> share = chunks_from_counter;
  /// Messages of the network: called after each sample of the calling thread, and while rank 0 waits.
  std::function<void()> between = [] {};
  /// Waits until all have come here.
  std::function<void()> barrier = [] {};
  /// Whether some process says yes. Called by all at the same place.
  std::function<bool(bool)> any = [](bool mine) { return mine; };
  [[nodiscard]] bool first() const { return rank == 0; }
};

/// The command `study` of a team, whose processes compute on one thread each unless told otherwise;
/// `setup_study` (commands.h) is that of a process of its own.
void setup_team_study(CLI::App& program, int& status, const StudyTeam& team);

/// Arguments and options of `study` but those of Talk; each --option checks itself.
void add_study_options(CLI::App& command, StudyCommand& options);

/// Returns the exit code: 0, or 2 where it was stopped or a nominal sweep fails. Throws InputError; on
/// a team the process that throws must end the others.
int run_study(const StudyCommand& command, const StudyTeam& team = {});

}  // namespace condyle
