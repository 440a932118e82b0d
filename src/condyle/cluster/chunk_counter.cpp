#include "condyle/cluster/chunk_counter.h"

#include <stdexcept>

namespace condyle {
namespace {

constexpr std::chrono::microseconds kProgressEvery(500);

}  // namespace

ChunkCounter::ChunkCounter(MPI_Comm ranks) : ranks_(ranks) {
  int rank = 0;
  MPI_Comm_rank(ranks_, &rank);
  const MPI_Aint bytes = rank == 0 ? static_cast<MPI_Aint>(sizeof *value_) : 0;
  MPI_Comm_set_errhandler(ranks_, MPI_ERRORS_RETURN);
  const int made = MPI_Win_allocate(bytes, static_cast<int>(sizeof *value_), MPI_INFO_NULL, ranks_,
                                    static_cast<void*>(&value_), &window_);
  MPI_Comm_set_errhandler(ranks_, MPI_ERRORS_ARE_FATAL);
  if (made != MPI_SUCCESS)
    throw std::runtime_error(
        "MPI makes no window over these machines, expected one-sided communication (OpenMPI: "
        "components \"osc\")");
  MPI_Win_lock_all(MPI_MODE_NOCHECK, window_);
  if (rank == 0) {
    *value_ = 0;
    MPI_Win_sync(window_);
  }
  MPI_Barrier(ranks_);
}

ChunkCounter::~ChunkCounter() {
  MPI_Win_unlock_all(window_);
  MPI_Win_free(&window_);
}

std::uint64_t ChunkCounter::take() {
  const std::lock_guard<std::mutex> lock(within_mpi_);
  const std::uint64_t one = 1;
  std::uint64_t taken = 0;
  MPI_Fetch_and_op(&one, &taken, MPI_UINT64_T, 0, 0, MPI_SUM, window_);
  MPI_Win_flush(0, window_);
  return taken;
}

void ChunkCounter::progress() {
  const std::unique_lock<std::mutex> lock(within_mpi_, std::try_to_lock);
  const Clock::time_point now = Clock::now();
  if (!lock || now - last_progress_ < kProgressEvery) return;
  // One call hears a question, another one answers it.
  for (int call = 0; call < 2; ++call) {
    int there = 0;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, ranks_, &there, MPI_STATUS_IGNORE);
  }
  last_progress_ = now;
}

}  // namespace condyle
