/// What a sample costs, everything included: poses a second and core where the reference strains and
/// stiffnesses of the Wismans-type knee and of the phantom vary, and what two threads make of it.
///
///     condyle_study_speed DATA [SECONDS]
///
/// DATA: the folder of the shipped scenes. SECONDS: of each measurement, about; the best of several that
/// take turns is told.

#include <fmt/format.h>

#include <time.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "condyle/scene_file/read_scene.h"
#include "condyle/study/study_chunk.h"
#include "condyle/study/study_worker.h"

namespace condyle {
namespace {

VariedNumber of_all_ligaments(const Scene& scene, ParameterKind what, double sd) {
  VariedNumber varied;
  varied.number.what = what;
  varied.number.prior_sd = sd;
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
    varied.number.of.push_back(static_cast<int>(i));
  return varied;
}

/// Sds of the literature: 0.02 of reference strains, 30 % of stiffnesses.
StudyPlan plan_of(const std::filesystem::path& scene, long samples) {
  ReadStudy study;
  study.study.file = "speed";
  study.study.samples = samples;
  study.scenes.push_back(read_scene(scene));
  study.varied.push_back({of_all_ligaments(study.scenes[0], ParameterKind::kReferenceStrain, 0.02),
                          of_all_ligaments(study.scenes[0], ParameterKind::kStiffness, 0.3)});
  return study_plan(std::move(study));
}

double now(clockid_t clock) {
  timespec t{};
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// CPU seconds of one thread for the first samples of a plan, and how many poses failed.
double seconds_alone(const StudyPlan& plan, std::uint64_t samples, long& failed) {
  StudyWorker worker(plan, study_models(plan));
  std::vector<std::uint8_t> status(plan.values.size());
  std::vector<double> values(plan.numbers());
  worker.evaluate(0, status.data(), values.data());
  const double begin = now(CLOCK_THREAD_CPUTIME_ID);
  failed = 0;
  for (std::uint64_t k = 0; k < samples; ++k) {
    worker.evaluate(k, status.data(), values.data());
    failed += std::count_if(status.begin(), status.end(), [](std::uint8_t s) { return s != 0; });
  }
  return now(CLOCK_THREAD_CPUTIME_ID) - begin;
}

double seconds_on(int threads, const StudyPlan& plan) {
  std::vector<std::uint64_t> all;
  for (std::uint64_t c = 0; c < chunk_count(plan); ++c) all.push_back(c);
  const double begin = now(CLOCK_MONOTONIC);
  run_chunks(plan, threads, chunks_from_counter(std::move(all)),
             [](int, const StudyChunk&) { return true; });
  return now(CLOCK_MONOTONIC) - begin;
}

void measure(const std::filesystem::path& scene, double seconds) {
  StudyPlan plan = plan_of(scene, 1 << 20);
  long failed = 0;
  const double each = seconds_alone(plan, 64, failed) / 64;
  const auto samples = std::max<std::uint64_t>(64, static_cast<std::uint64_t>(seconds / each));
  plan.points = (samples + 2 * kChunkSamples - 1) / (2 * kChunkSamples) * (2 * kChunkSamples);
  constexpr int kTurns = 5;
  double alone = 1e9, one = 1e9, two = 1e9;
  for (int turn = 0; turn < kTurns; ++turn) {
    alone = std::min(alone, seconds_alone(plan, plan.points, failed));
    one = std::min(one, seconds_on(1, plan));
    two = std::min(two, seconds_on(2, plan));
  }
  const auto poses = static_cast<double>(plan.points * plan.values.size());
  fmt::print(
      "{:30} {:9.0f} poses/s and core  {:7.2f} us a pose  {:6.3f} % failed  "
      "2 threads: efficiency {:.2f}\n",
      scene.parent_path().filename().string() + "/" + scene.filename().string(), poses / alone,
      1e6 * alone / poses, 100 * static_cast<double>(failed) / poses, one / (2 * two));
}

}  // namespace
}  // namespace condyle

int main(int count, char** words) {
  try {
    const std::filesystem::path data = count > 1 ? words[1] : "data";
    const double seconds = count > 2 ? std::atof(words[2]) : 0.5;
    for (const char* scene : {"wismans-type/knee.toml", "phantom/knee.toml"})
      condyle::measure(data / scene, seconds);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
