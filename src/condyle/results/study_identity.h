#pragma once

/// What the samples of a study depend on, as hashes by name: chunks of a study that differs in any of
/// them are of no use to it.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "condyle/study/study_plan.h"

namespace condyle {

/// "study" (its text), "seed", "number of samples", "design", "table of the design", "program" (its
/// version), "kind of processor" (with or without fused multiply-add: the last bits differ), and of each
/// knee "scene knee.toml", "meshes knee.toml", "surfaces knee.toml".
using StudyIdentity = std::vector<std::pair<std::string, std::uint64_t>>;
[[nodiscard]] StudyIdentity study_identity(const StudyPlan& plan);

/// The head of a journal.
[[nodiscard]] std::string head_of(const StudyIdentity& identity);
/// As every head, of whatever study.
[[nodiscard]] bool begins_as_head(std::string_view bytes);
/// The bytes of a head that `bytes` begin with; 0: it is torn or damaged.
[[nodiscard]] std::size_t head_size(std::string_view bytes);
/// Throws InputError naming `file` and what differs, where a head is not that of `identity`.
void expect_same_study(const std::string& file,
                       std::string_view head,
                       const StudyIdentity& identity);

}  // namespace condyle
