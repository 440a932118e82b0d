#include "condyle/study/study_chunk.h"

#include <algorithm>
#include <atomic>
#include <climits>
#include <exception>
#include <memory>
#include <thread>
#include <utility>

#include "condyle/start_threads.h"
#include "condyle/study/study_worker.h"

namespace condyle {
namespace {

/// One computation of chunks by all threads.
class ChunkRun {
 public:
  ChunkRun(const StudyPlan& plan,
           std::shared_ptr<const StudyModels> models,
           const NextChunk& next,
           const KeepChunk& keep,
           const std::function<bool()>& between)
      : plan_(plan), next_(next), keep_(keep), between_(between), models_(std::move(models)) {}

  bool on(int threads) {
    std::vector<std::exception_ptr> errors(static_cast<std::size_t>(threads));
    const auto work = [&](int worker) {
      try {
        compute(worker);
      } catch (...) {
        errors[static_cast<std::size_t>(worker)] = std::current_exception();
        stopped_ = true;
      }
    };
    {
      const std::vector<std::jthread> others = start_threads(1, threads, work);
      work(0);
    }
    for (const std::exception_ptr& error : errors)
      if (error) std::rethrow_exception(error);
    return !stopped_;
  }

 private:
  void compute(int worker) {
    StudyWorker own(plan_, models_);
    StudyChunk chunk;
    while (!stopped_) {
      const std::optional<std::uint64_t> index = next_();
      if (!index) return;
      if (!fill(*index, worker == 0, own, chunk)) return;
      if (!keep_(worker, chunk)) stopped_ = true;
    }
  }

  /// False where it was stopped: the chunk is not whole.
  bool fill(std::uint64_t index, bool calling, StudyWorker& worker, StudyChunk& chunk) {
    const std::uint64_t first = index * kChunkSamples;
    chunk.index = index;
    chunk.samples = std::min(kChunkSamples, plan_.samples() - first);
    chunk.status.resize(chunk.samples * plan_.values.size());
    chunk.values.resize(chunk.samples * plan_.numbers());
    for (std::uint64_t i = 0; i < chunk.samples; ++i) {
      worker.evaluate(first + i, chunk.status.data() + i * plan_.values.size(),
                      chunk.values.data() + i * plan_.numbers());
      if (calling && between_ && !between_()) stopped_ = true;
      if (stopped_ && i + 1 < chunk.samples) return false;
    }
    return true;
  }

  const StudyPlan& plan_;
  const NextChunk& next_;
  const KeepChunk& keep_;
  const std::function<bool()>& between_;
  std::shared_ptr<const StudyModels> models_;
  std::atomic<bool> stopped_ = false;
};

}  // namespace

std::uint64_t chunk_count(const StudyPlan& plan) {
  return (plan.samples() + kChunkSamples - 1) / kChunkSamples;
}

int samples_of_chunks(std::uint64_t chunks) {
  return static_cast<int>(std::min<std::uint64_t>(chunks * kChunkSamples, INT_MAX));
}

NextChunk chunks_from_counter(std::vector<std::uint64_t> wanted) {
  struct Counter {
    std::vector<std::uint64_t> wanted;
    std::atomic<std::size_t> next = 0;
  };
  const auto counter = std::make_shared<Counter>();
  counter->wanted = std::move(wanted);
  return [counter]() -> std::optional<std::uint64_t> {
    const std::size_t k = counter->next++;
    if (k >= counter->wanted.size()) return std::nullopt;
    return counter->wanted[k];
  };
}

bool run_chunks(const StudyPlan& plan,
                std::shared_ptr<const StudyModels> models,
                int threads,
                const NextChunk& next,
                const KeepChunk& keep,
                const std::function<bool()>& between) {
  return ChunkRun(plan, std::move(models), next, keep, between).on(thread_count(threads));
}

bool run_chunks(const StudyPlan& plan,
                int threads,
                const NextChunk& next,
                const KeepChunk& keep,
                const std::function<bool()>& between) {
  return run_chunks(plan, study_models(plan), threads, next, keep, between);
}

}  // namespace condyle
