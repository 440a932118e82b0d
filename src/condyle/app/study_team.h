#pragma once

/// Who computes a study together.

#include <cstdint>
#include <functional>
#include <vector>

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

}  // namespace condyle
