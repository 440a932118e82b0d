#include "condyle/cluster/ranks.h"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "condyle/app/program.h"
#include "condyle/app/tell.h"
#include "condyle/cluster/chunk_counter.h"
#include "condyle/input_error.h"

namespace condyle {
namespace {

constexpr std::chrono::microseconds kLookEvery(500);
constexpr std::chrono::seconds kAfterRankZero(1);

void wait(MPI_Request request) {
  for (int done = 0;;) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return;
    std::this_thread::sleep_for(kLookEvery);
  }
}

/// From rank 0 to all, whose lists have the length of its own already. MPI counts in int.
void broadcast(std::vector<std::uint64_t>& numbers) {
  constexpr std::size_t kAtOnce = 1U << 24U;
  for (std::size_t i = 0; i < numbers.size(); i += kAtOnce)
    MPI_Bcast(&numbers[i], static_cast<int>(std::min(kAtOnce, numbers.size() - i)), MPI_UINT64_T, 0,
              MPI_COMM_WORLD);
}

std::string machine() {
  std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
  int length = 0;
  MPI_Get_processor_name(name.data(), &length);
  return {name.data(), static_cast<std::size_t>(length)};
}

}  // namespace

Ranks::Ranks(int& argc, char**& argv) {
  // OpenMPI 4 as Debian sets it makes windows within one machine only, and with UCX fails where there
  // is no InfiniBand. What the user sets counts.
  ::setenv("OMPI_MCA_osc", "^ucx", 0);
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  if (provided < MPI_THREAD_SERIALIZED)
    end_all("MPI lets one thread alone ask, expected MPI_THREAD_SERIALIZED");
}

Ranks::~Ranks() {
  barrier();
  counter_.reset();
  MPI_Finalize();
}

void Ranks::end_all(const std::string& message) const {
  if (rank_ == 0) {
    tell(stderr, "condyle-mpi: {}\n", printable_line(message));
  } else {
    std::this_thread::sleep_for(kAfterRankZero);
    tell(stderr, "condyle-mpi: rank {} on {}: {}\n", rank_, machine(), printable_line(message));
  }
  std::fflush(stderr);
  MPI_Abort(MPI_COMM_WORLD, kBadInput);
  std::abort();
}

void Ranks::barrier() const {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  wait(request);
}

bool Ranks::any(bool mine) const {
  const int one = mine ? 1 : 0;
  int all = 0;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallreduce(&one, &all, 1, MPI_INT, MPI_LOR, MPI_COMM_WORLD, &request);
  wait(request);
  return all != 0;
}

void Ranks::expect_same(const StudyIdentity& identity) const {
  barrier();  // others may have read and fitted their knees long before
  std::vector<std::uint64_t> first;
  for (const auto& what : identity) first.push_back(what.second);
  std::uint64_t count = first.size();
  MPI_Bcast(&count, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  first.resize(count);
  broadcast(first);
  const auto refuse = [](const std::string& what) {
    throw InputError(
        fmt::format("the {} is not that of rank 0, expected the same study on all machines", what));
  };
  if (count != identity.size()) refuse("list of scenes");
  for (std::size_t i = 0; i < count; ++i)
    if (first[i] != identity[i].second) refuse(identity[i].first);
}

NextChunk Ranks::share(std::vector<std::uint64_t> missing) {
  std::uint64_t count = missing.size();
  MPI_Bcast(&count, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  missing.resize(count);
  broadcast(missing);
  counter_ = std::make_unique<ChunkCounter>(MPI_COMM_WORLD);
  const auto wanted = std::make_shared<const std::vector<std::uint64_t>>(std::move(missing));
  return [counter = counter_.get(), wanted]() -> std::optional<std::uint64_t> {
    const std::uint64_t i = counter->take();
    if (i >= wanted->size()) return std::nullopt;
    return (*wanted)[i];
  };
}

StudyTeam Ranks::team() {
  StudyTeam team;
  team.rank = rank_;
  team.size = size_;
  team.expect_same = [this](const StudyIdentity& identity) { expect_same(identity); };
  team.share = [this](std::vector<std::uint64_t> missing) { return share(std::move(missing)); };
  team.between = [this] {
    if (rank_ == 0 && counter_ != nullptr) counter_->progress();
  };
  team.barrier = [this] { barrier(); };
  team.any = [this](bool mine) { return any(mine); };
  return team;
}

}  // namespace condyle
