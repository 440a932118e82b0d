#pragma once

/// Derivatives as people compare them: what a typical change of each number of the knee does to a
/// pose, in deg, mm, N or N m.

#include <cstddef>
#include <string>
#include <vector>

#include "condyle/results/run_file.h"

namespace condyle {

struct SceneParameter;

/// As great as such numbers are uncertain: 0.01 of a strain, 10 % of a stiffness, of a load's scale
/// and of a modulus, 1 mm of lengths, insertions and shifts, 1 deg of an angle, 10 % of the size of
/// a load's vector for each of its components.
struct TypicalChange {
  double inside = 0;   ///< in the parameter's unit used inside
  std::string amount;  ///< "+0.01", "+10 %", "+1 mm"
  std::string words;   ///< "0.01 more strain of aACL"
};
[[nodiscard]] TypicalChange typical_change(const Scene& scene, const SceneParameter& parameter);

enum class EffectGroup { kRotation, kTranslation, kForce, kMoment };
inline constexpr std::size_t kEffectGroups = 4;
/// "°", "mm", "N", "N m"
[[nodiscard]] const char* unit_of(EffectGroup group);

struct EffectOutput {
  std::size_t index = 0;  ///< of SweepSensitivities::outputs
  EffectGroup group = EffectGroup::kRotation;
  std::string name;        ///< "anterior drawer", "medial", "aACL", "flexion"
  std::string more, less;  ///< "forwards", "back"; what a change of either sign is
  double per_inside = 1;   ///< to the unit of the group
};
[[nodiscard]] std::vector<EffectOutput> effect_outputs(const Run& run);

/// Of the typical change of parameter `j` at a pose; NaN where that has no derivatives.
[[nodiscard]] double effect(const Run& run,
                            std::size_t pose,
                            const EffectOutput& output,
                            std::size_t j,
                            const TypicalChange& change);

/// Up to four poses that have derivatives: those nearest to 0, 30, 60 and 90 deg of flexion where
/// the sweep has two of them, else evenly over the sweep.
[[nodiscard]] std::vector<std::size_t> shown_sensitivities(const Run& run);

}  // namespace condyle
