#pragma once

#include <functional>
#include <optional>

namespace condyle::test {

/// Machine instructions that `work` takes, counted one by one: a copy of the process does the work
/// while this one steps through it (ptrace). Reading the clock is left out. About 0.1 ms for each
/// on a slow machine, so a pose, not a sweep. Absent where the system does not allow it, and under
/// a sanitizer.
[[nodiscard]] std::optional<long> count_instructions(const std::function<void()>& work);

}  // namespace condyle::test
