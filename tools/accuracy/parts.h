#pragma once

/// What one scene of part_scenes.h costs, measured in a process of its own, so that its memory is
/// its own too.

#include <string>
#include <string_view>

namespace condyle::accuracy {

/// An argument that starts so names the scene to measure.
inline constexpr std::string_view kPartPrefix = "part:";

/// Measures, prints one line for study_parts, and returns the exit code.
int measure_part(const std::string& name);

}  // namespace condyle::accuracy
