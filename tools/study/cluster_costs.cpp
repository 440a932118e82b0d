/// condyle_cluster_costs: what the parts of a study on a cluster cost here, and from that, on paper, where
/// 1,000 cores and 1e9 poses would saturate. Two ranks, as tools/study/cluster_costs.sh starts them.
///
///   mpirun -n 2 condyle_cluster_costs counter
///   mpirun -n 2 condyle_cluster_costs STUDY.toml FOLDER US_OVER_TCP

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "condyle/cluster/chunk_counter.h"
#include "condyle/results/study_file.h"
#include "condyle/scene_file/read_study.h"
#include "condyle/study/study_worker.h"

namespace condyle::cluster_costs {
namespace {

namespace fs = std::filesystem;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double median(std::vector<double> numbers) {
  std::nth_element(numbers.begin(), numbers.begin() + static_cast<long>(numbers.size() / 2),
                   numbers.end());
  return numbers[numbers.size() / 2];
}

/// Median time of one number for rank 1 while rank 0 is within MPI [s]; on rank 0 nothing of meaning.
double time_of_a_number(int rank) {
  constexpr int kNumbers = 2000;
  ChunkCounter counter(MPI_COMM_WORLD);
  std::vector<double> times(kNumbers, 0.0);
  if (rank == 1) {
    for (double& time : times) {
      const double begin = now();
      (void)counter.take();
      time = now() - begin;
    }
  }
  MPI_Barrier(MPI_COMM_WORLD);
  double time = median(times);
  MPI_Bcast(&time, 1, MPI_DOUBLE, 1, MPI_COMM_WORLD);
  return time;
}

/// Of one chunk of this study [s], [bytes].
struct Costs {
  double setup = 0, chunk = 0, journal = 0, merge = 0;
  double bytes = 0;
  std::uint64_t chunks = 0;
  std::size_t poses = 0;
};

Costs costs_of(const fs::path& file, const fs::path& folder) {
  Costs costs;
  double begin = now();
  const StudyPlan plan = study_plan(read_study(file));
  const auto models = study_models(plan);
  costs.setup = now() - begin;
  std::vector<const SweepResult*> nominal;
  for (std::size_t knee = 0; knee < plan.knees.size(); ++knee)
    nominal.push_back(&nominal_sweep(*models, knee));
  const fs::path result = folder / "costs.h5";
  StudyJournals journals(result, plan, {}, false);
  costs.chunks = chunk_count(plan);
  costs.poses = plan.values.size();
  begin = now();
  run_chunks(plan, models, 1, chunks_from_counter(journals.missing()),
             [&](int worker, const auto& chunk) {
               const double start = now();
               journals.append(worker, chunk);
               costs.journal += now() - start;
               return true;
             });
  const auto count = static_cast<double>(costs.chunks);
  costs.chunk = (now() - begin - costs.journal) / count;
  costs.journal /= count;
  for (const auto& entry : fs::recursive_directory_iterator(StudyJournals::folder(result)))
    if (entry.is_regular_file()) costs.bytes += static_cast<double>(entry.file_size());
  costs.bytes /= count;
  begin = now();
  (void)write_study(result, plan, journals, nominal);
  costs.merge = (now() - begin) / count;
  journals.remove();
  return costs;
}

void print_costs(const Costs& costs, double number, double number_over_tcp) {
  fmt::print("| part | measured |\n|---|---|\n");
  fmt::print("| a number from the counter, two ranks of one machine | {:.1f} us |\n", 1e6 * number);
  fmt::print("| the same by TCP (loopback), rank 0 waiting | {:.0f} us |\n", number_over_tcp);
  fmt::print("| set-up of a rank | {:.2f} s |\n", costs.setup);
  fmt::print("| a chunk: {} samples of {} poses | {:.1f} ms |\n", kChunkSamples, costs.poses,
             1e3 * costs.chunk);
  fmt::print("| its record in a journal: {:.0f} kB | {:.2f} ms |\n", costs.bytes / 1e3,
             1e3 * costs.journal);
  fmt::print("| merge with bands and correlations | {:.1f} s/GB |\n\n",
             1e9 * costs.merge / costs.bytes);
}

/// All as measured, on cores as fast as this one.
void print_paper(const Costs& costs, double number_over_tcp) {
  constexpr double kCores = 1000, kPoses = 1e9;
  const double chunks = kPoses / static_cast<double>(kChunkSamples * costs.poses);
  const double compute = chunks * costs.chunk / kCores;
  const double rate = chunks / compute;  // [1/s]
  const double counter = rate * number_over_tcp * 1e-6;
  const double bytes = rate * costs.bytes;
  const double disk = costs.bytes / costs.journal;  // of one writer [bytes/s]
  const double merge = chunks * costs.merge;
  fmt::print("| 1,000 cores, 1e9 poses | needs | has | share |\n|---|---|---|---|\n");
  fmt::print("| computing | {:.0f} s | | |\n", compute);
  fmt::print(
      "| counter | {:.0f} numbers a second | {:.0f}, one asked after the other | {:.1f} % |\n",
      rate, 1e6 / number_over_tcp, 100 * counter);
  fmt::print(
      "| journals | {:.2f} GB/s, {:.0f} GB in all | {:.2f} GB/s, one writer here | {:.0f} % |\n",
      bytes / 1e9, chunks * costs.bytes / 1e9, disk / 1e9, 100 * bytes / disk);
  fmt::print(
      "| a journal's records, of a rank's time | {:.2f} ms a chunk | {:.1f} ms | {:.2f} % |\n",
      1e3 * costs.journal, 1e3 * costs.chunk, 100 * costs.journal / costs.chunk);
  fmt::print("| set-up of each rank | {:.2f} s | {:.0f} s | {:.2f} % |\n", costs.setup, compute,
             100 * costs.setup / compute);
  fmt::print("| merge, by rank 0 alone | {:.0f} s | {:.0f} s | {:.0f} % |\n\n", merge, compute,
             100 * merge / compute);
  fmt::print("At {:.0f} cores the counter is asked as fast as it can answer.\n", kCores / counter);
}

int run(int argc, char** argv, int rank) {
  const double number = time_of_a_number(rank);
  if (rank == 0 && argc == 2) fmt::print("{:.1f}\n", 1e6 * number);
  if (rank == 0 && argc == 4) {
    const Costs costs = costs_of(argv[1], argv[2]);
    print_costs(costs, number, std::stod(argv[3]));
    print_paper(costs, std::stod(argv[3]));
  }
  // The other one sleeps meanwhile.
  MPI_Request all = MPI_REQUEST_NULL;
  MPI_Ibarrier(MPI_COMM_WORLD, &all);
  for (int done = 0; done == 0; MPI_Test(&all, &done, MPI_STATUS_IGNORE))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return 0;
}

}  // namespace
}  // namespace condyle::cluster_costs

int main(int argc, char** argv) {
  int provided = 0, rank = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  try {
    const int status = condyle::cluster_costs::run(argc, argv, rank);
    MPI_Finalize();
    return status;
  } catch (const std::exception& error) {
    fmt::print(stderr, "condyle_cluster_costs: {}\n", error.what());
  }
  MPI_Abort(MPI_COMM_WORLD, 1);
}
