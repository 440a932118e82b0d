#include "condyle/python/compute_study.h"

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>

#include "condyle/input_error.h"
#include "condyle/python/interrupts.h"
#include "condyle/results/make_run.h"
#include "condyle/results/output_file.h"
#include "condyle/results/temporary_folder.h"
#include "condyle/start_threads.h"
#include "condyle/study/study_worker.h"

namespace condyle::python {
namespace {

namespace fs = std::filesystem;

void check_output(const StudyToCompute& asked) {
  check_output_file(asked.output, ".h5");
  refuse_to_overwrite(asked.output, {asked.read.study.file, asked.read.study.table});
  for (const Scene& scene : asked.read.scenes) refuse_to_overwrite_inputs(asked.output, scene);
}

/// Samples told at most twenty times a second, and at the end.
class SamplesTold {
 public:
  SamplesTold(const OnProgress& progress, std::uint64_t chunks)
      : progress_(progress), chunks_(chunks) {}
  void at(std::uint64_t done) {
    const auto now = std::chrono::steady_clock::now();
    if (!progress_ || done == told_ || (done < chunks_ && now < next_)) return;
    next_ = now + std::chrono::milliseconds(50);
    told_ = done;
    progress_(samples_of_chunks(done), samples_of_chunks(chunks_));
  }

 private:
  const OnProgress& progress_;
  std::uint64_t chunks_, told_ = UINT64_MAX;
  std::chrono::steady_clock::time_point next_ = {};
};

/// Throws what `progress` throws; otherwise stops where it should.
void compute_chunks(const StudyPlan& plan,
                    const std::shared_ptr<const StudyModels>& models,
                    int threads,
                    StudyJournals& journals,
                    const OnProgress& progress,
                    const std::function<bool()>& should_stop) {
  const std::vector<std::uint64_t> missing = journals.missing();
  std::atomic<std::uint64_t> done = 0;
  SamplesTold told(progress, missing.size());
  std::exception_ptr raised;  // on this thread, which alone calls `between`
  const auto between = [&] {
    try {
      told.at(done);
    } catch (...) {
      raised = std::current_exception();
    }
    return !raised && !should_stop();
  };
  const KeepChunk keep = [&](int worker, const StudyChunk& chunk) {
    journals.append(worker, chunk);
    ++done;
    return !should_stop();
  };
  const bool all = run_chunks(plan, models, threads, chunks_from_counter(missing), keep, between);
  if (all && !raised) (void)between();
  if (raised) std::rethrow_exception(raised);
}

/// Under the interpreter's lock.
void write_result(const fs::path& output,
                  const StudyPlan& plan,
                  const StudyModels& models,
                  const StudyJournals& journals,
                  const StudyProvenance& provenance) {
  std::vector<const SweepResult*> nominal;
  for (std::size_t k = 0; k < plan.knees.size(); ++k) nominal.push_back(&nominal_sweep(models, k));
  (void)write_study(output, plan, journals, nominal, provenance, [](int, int) {
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
  });
}

}  // namespace

std::shared_ptr<StudyColumns> compute_study(StudyToCompute asked, const OnProgress& progress) {
  std::optional<TemporaryFolder> temporary;
  if (asked.output.empty()) asked.output = temporary.emplace().path() / "study.h5";
  check_output(asked);
  const auto begin = std::chrono::steady_clock::now();
  StudyPlan plan;
  run_interruptibly(OnProgress(), [&](const OnProgress& on_knee) {
    plan = study_plan(std::move(asked.read), on_knee);
  });
  expect_room(asked.output, plan);
  StudyJournals journals(asked.output, plan, StudyPart{}, asked.resume);
  if (asked.resume && journals.count() == 0 && holds_study(asked.output, plan)) {
    journals.remove();
    return open_study(asked.output, ReadBy::kThisProcess);
  }
  const int threads = thread_count(asked.threads);
  std::shared_ptr<const StudyModels> models;
  run_interruptibly([&](const std::function<bool()>& should_stop) {
    models = study_models(plan);
    compute_chunks(plan, models, threads, journals, progress, should_stop);
  });
  journals.read_again();
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
  write_result(asked.output, plan, *models, journals, {passed.count(), threads, 1});
  journals.remove();
  return open_study(asked.output, ReadBy::kThisProcess);
}

}  // namespace condyle::python
