#pragma once

/// The numbers of a described ligament, by their kinds.

#include <array>
#include <string>

#include "condyle/scene/scene.h"

namespace condyle {

/// The kinds of numbers that laws have.
inline constexpr std::array<ParameterKind, 4> kNumbersOfLaws = {
    ParameterKind::kReferenceStrain, ParameterKind::kSlackLength, ParameterKind::kStiffness,
    ParameterKind::kTransitionStrain};

/// "reference_strain", ...: what a scene calls a number of that kind; of an insertion without its body.
[[nodiscard]] const char* word_of(ParameterKind kind);

/// Whether a law has a number of that kind; of an insertion always.
[[nodiscard]] bool has_number(const ForceLaw& law, ParameterKind kind);

/// "toe-linear or quadratic": the laws that have one.
[[nodiscard]] std::string laws_with(ParameterKind kind);

/// Reference strain [-], slack length [mm], stiffness [N] or [N/mm²], transition strain [-] of a law
/// that has it. The reference strain is that of the length at the start pose; NaN where its path is not
/// known yet (has_known_path).
[[nodiscard]] double number_of(const Scene& scene,
                               const LigamentDescription& ligament,
                               ParameterKind kind);

}  // namespace condyle
