#pragma once

/// The ranks of a network as a team that works on one study: MPI from its start to its end, once in a
/// program. All waits sleep between looks, so that a rank that waits takes no time from one that works.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "condyle/app/run_study.h"

namespace condyle {

class ChunkCounter;

class Ranks {
 public:
  /// Starts MPI (MPI_THREAD_SERIALIZED).
  Ranks(int& argc, char**& argv);
  /// Waits for all ranks, and ends MPI: not while an exception passes.
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] int rank() const { return rank_; }
  [[nodiscard]] int size() const { return size_; }
  /// Refers to this.
  [[nodiscard]] StudyTeam team();
  /// One line on the standard error, and the end of all ranks, with the exit code of bad input. What
  /// rank 0 says comes first: it often is what the others would say.
  [[noreturn]] void end_all(const std::string& message) const;

 private:
  void expect_same(const StudyIdentity& identity) const;
  [[nodiscard]] NextChunk share(std::vector<std::uint64_t> missing);
  void barrier() const;
  [[nodiscard]] bool any(bool mine) const;

  int rank_ = 0, size_ = 1;
  std::unique_ptr<ChunkCounter> counter_;
};

}  // namespace condyle
