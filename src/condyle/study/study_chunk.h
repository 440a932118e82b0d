#pragma once

/// Samples that are computed at one go, by whoever takes them: the unit of journals and of what a kill
/// may cost.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "condyle/contact/pose_status.h"
#include "condyle/study/study_plan.h"

namespace condyle {

inline constexpr std::uint64_t kChunkSamples = 64;

struct StudyChunk {
  std::uint64_t index = 0;           ///< its first sample is index * kChunkSamples
  std::uint64_t samples = 0;         ///< the last one may have fewer
  std::vector<std::uint8_t> status;  ///< PoseStatus, by samples and poses
  std::vector<double> values;        ///< by samples, poses and outputs, in the outputs' units; NaN
                                     ///< where a pose is not solved
};

[[nodiscard]] std::uint64_t chunk_count(const StudyPlan& plan);
/// How many samples whole chunks hold, for those who tell of progress: INT_MAX at most.
[[nodiscard]] int samples_of_chunks(std::uint64_t chunks);

/// Hands out the numbers of chunks, each once; none when there are no more. Threads may ask at the same
/// time.
using NextChunk = std::function<std::optional<std::uint64_t>()>;
/// Those of `wanted`, from one counter.
[[nodiscard]] NextChunk chunks_from_counter(std::vector<std::uint64_t> wanted);

/// Takes what was computed; called by `worker` alone from its own thread. False: stop.
using KeepChunk = std::function<bool(int worker, const StudyChunk& chunk)>;

/// Computes chunks until there are no more, on that many threads (0: as many as there are cores). The
/// numbers do not depend on who computes what. `between`: called by the calling thread after each of its
/// samples (progress, messages of a network); false: stop.
/// False where it was stopped. Rethrows the first exception of a thread.
bool run_chunks(const StudyPlan& plan,
                int threads,
                const NextChunk& next,
                const KeepChunk& keep,
                const std::function<bool()>& between = {});
/// The same with models that are there already.
class StudyModels;
bool run_chunks(const StudyPlan& plan,
                std::shared_ptr<const StudyModels> models,
                int threads,
                const NextChunk& next,
                const KeepChunk& keep,
                const std::function<bool()>& between = {});

}  // namespace condyle
