#pragma once

/// What a reader of a comparison must know before its numbers, a sentence each.

#include <string>
#include <vector>

#include "condyle/report/compared_runs.h"

namespace condyle {

/// Sides, units of the scenes, what each run sweeps, poses at other places, curves that go to and fro,
/// and quantities that only some of the runs have.
[[nodiscard]] std::vector<std::string> words_of(const RunComparison& comparison);

/// "a, b and c"
[[nodiscard]] std::string enumerated(const std::vector<std::string>& items);

}  // namespace condyle
