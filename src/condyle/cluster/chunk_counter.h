#pragma once

/// One counter for all ranks of a network: MPI_Fetch_and_op on a window of rank 0 (passive target [MPI
/// 3.1, 11.5.3]), so that no rank only hands out work.
///
/// Within a machine the number is fetched from shared memory; between machines rank 0 answers whenever it
/// is within MPI, so it has to call progress() between its own pieces of work.

#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <mutex>

namespace condyle {

class ChunkCounter {
 public:
  /// Called by all ranks together. Throws std::runtime_error where MPI makes no window.
  explicit ChunkCounter(MPI_Comm ranks);
  /// By all ranks together: not while an exception passes.
  ~ChunkCounter();
  ChunkCounter(const ChunkCounter&) = delete;
  ChunkCounter& operator=(const ChunkCounter&) = delete;

  /// 0, 1, 2 ...: each once over all ranks. Threads may ask at the same time; one of them is within MPI
  /// (MPI_THREAD_SERIALIZED).
  [[nodiscard]] std::uint64_t take();
  /// Lets waiting ranks have their numbers, unless a thread is within MPI anyway or it was just done.
  void progress();

 private:
  using Clock = std::chrono::steady_clock;
  MPI_Comm ranks_;
  MPI_Win window_ = MPI_WIN_NULL;
  std::uint64_t* value_ = nullptr;  ///< of rank 0
  Clock::time_point last_progress_;
  std::mutex within_mpi_;
};

}  // namespace condyle
