#include "condyle/scene/ligament_number.h"

#include <array>
#include <variant>

#include "condyle/math/no_number.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"

namespace condyle {
namespace {

double stiffness_of(const ForceLaw& law) {
  if (const auto* quadratic = std::get_if<QuadraticLaw>(&law)) return quadratic->stiffness;
  return std::get<ToeLinearLaw>(law).stiffness;
}

double reference_strain_of(const Scene& scene, const LigamentDescription& ligament) {
  if (ligament.reference_strain) return *ligament.reference_strain;
  if (!has_known_path(scene, ligament)) return kNoNumber;
  return ligament_length(scene, ligament, start_pose(scene)) / slack_length(ligament.law) - 1;
}

}  // namespace

const char* word_of(ParameterKind kind) {
  constexpr std::array<const char*, 11> kWords = {"reference_strain",
                                                  "slack_length",
                                                  "stiffness",
                                                  "transition_strain",
                                                  "insertion",
                                                  "scale",
                                                  "vector",
                                                  "point",
                                                  "value",
                                                  "shift",
                                                  "modulus"};
  static_assert(static_cast<std::size_t>(ParameterKind::kLayerModulus) + 1 == kWords.size());
  return kWords.at(static_cast<std::size_t>(kind));
}

bool has_number(const ForceLaw& law, ParameterKind kind) {
  if (kind == ParameterKind::kInsertion) return true;
  const bool toe_linear = std::holds_alternative<ToeLinearLaw>(law);
  if (kind == ParameterKind::kTransitionStrain) return toe_linear;
  return toe_linear || std::holds_alternative<QuadraticLaw>(law);
}

std::string laws_with(ParameterKind kind) {
  return kind == ParameterKind::kTransitionStrain ? "toe-linear" : "toe-linear or quadratic";
}

double number_of(const Scene& scene, const LigamentDescription& ligament, ParameterKind kind) {
  switch (kind) {
    case ParameterKind::kReferenceStrain:
      return reference_strain_of(scene, ligament);
    case ParameterKind::kSlackLength:
      return slack_length(ligament.law);
    case ParameterKind::kStiffness:
      return stiffness_of(ligament.law);
    case ParameterKind::kTransitionStrain:
      return std::get<ToeLinearLaw>(ligament.law).transition_strain;
    default:
      return 0;
  }
}

}  // namespace condyle
