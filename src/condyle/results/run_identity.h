#pragma once

/// What poses belong to: a scene's text and the surfaces it led to. Poses of another scene are of
/// no use to a sweep that resumes.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/results/run_file.h"

namespace condyle {

struct RunIdentity {
  std::uint64_t scene = 0, surfaces = 0;  ///< hashes of the text, and of the patches
  bool operator==(const RunIdentity&) const = default;
};

/// 64 bits, Fowler-Noll-Vo (FNV-1a).
[[nodiscard]] std::uint64_t hash_bytes(std::string_view bytes,
                                       std::uint64_t hash = 0xcbf29ce484222325U);

[[nodiscard]] RunIdentity identity(const Scene& scene, const std::vector<FittedSurface>& surfaces);

/// Throws InputError, naming what differs, where `run` was computed from another scene or from
/// other patches. Patches may differ by `kSamePatch`: another machine may have rounded otherwise.
inline constexpr double kSamePatch = 1e-9;  // [mm]
void expect_same_scene(const std::string& file,
                       const Run& run,
                       const Scene& scene,
                       const std::vector<FittedSurface>& surfaces);

}  // namespace condyle
