/// The scene with other numbers (free_parameter.h).

#include <cmath>
#include <set>

#include "condyle/calibration/free_parameter.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"

namespace condyle {
namespace {

double start_length_of(const Scene& scene, const LigamentDescription& ligament) {
  return ligament_length(scene, ligament, start_pose(scene));
}

void set_slack_length_of(ForceLaw& law, double length) {
  if (auto* toe_linear = std::get_if<ToeLinearLaw>(&law)) toe_linear->slack_length = length;
  if (auto* quadratic = std::get_if<QuadraticLaw>(&law)) quadratic->slack_length = length;
}

/// Changes of one ligament, of all parameters together: its ends first, what follows from their distance
/// after them.
struct LigamentChange {
  std::array<Eigen::Vector3d, 2> ends = {Eigen::Vector3d::Zero(),
                                         Eigen::Vector3d::Zero()};  ///< on B, on A
  double strain = 0, slack_length = 0, transition_strain = 0, stiffness = 1;
  bool holds_strain = false;
};

void add_move(const ModelParameter& number, double by, LigamentChange& change) {
  switch (number.kind) {
    case ParameterKind::kReferenceStrain:
      change.strain += by;
      change.holds_strain = true;
      return;
    case ParameterKind::kSlackLength:
      change.slack_length += by;
      return;
    case ParameterKind::kTransitionStrain:
      change.transition_strain += by;
      return;
    default:
      break;
  }
  change.ends[number.body == OfBody::kFixed ? 0 : 1][number.component] += by;
  if (number.held == Held::kReferenceStrain) change.holds_strain = true;
}

void apply(const LigamentChange& change, const Scene& scene, LigamentDescription& ligament) {
  const double slack = slack_length(ligament.law);
  const bool strain_is_known = ligament.reference_strain || change.holds_strain;
  const double before = strain_is_known ? start_length_of(scene, ligament) : 0;
  for (Attachment& end : ligament.ends)
    end.at += change.ends[end.body == scene.fixed_body() ? 0 : 1];
  if (auto* law = std::get_if<ToeLinearLaw>(&ligament.law)) {
    law->stiffness *= change.stiffness;
    law->transition_strain += change.transition_strain;
  } else if (auto* quadratic = std::get_if<QuadraticLaw>(&ligament.law)) {
    quadratic->stiffness *= change.stiffness;
  }
  if (!(slack > 0)) return;
  set_slack_length_of(ligament.law, slack + change.slack_length);
  if (!strain_is_known) return;
  const double after = start_length_of(scene, ligament);
  if (change.holds_strain)
    set_slack_length_of(ligament.law, after / (before / slack + change.strain));
  if (ligament.reference_strain) ligament.reference_strain = after / slack_length(ligament.law) - 1;
}

}  // namespace

Scene scene_with(const Scene& scene,
                 const std::vector<FreeParameter>& parameters,
                 const std::vector<double>& theta) {
  Scene changed = scene;
  std::vector<LigamentChange> changes(scene.ligaments.size());
  std::set<std::size_t> touched;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const FreeParameter& parameter = parameters[j];
    for (const auto& [number, factor] : parameter.moves) {
      const double scale = std::exp(theta[j]);
      if (number.kind == ParameterKind::kLoadScale) {
        changed.loads[number.index].vector *= scale;
        continue;
      }
      touched.insert(number.index);
      if (parameter.logarithmic)
        changes[number.index].stiffness *= scale;
      else
        add_move(number, factor * theta[j], changes[number.index]);
    }
  }
  for (const std::size_t i : touched) apply(changes[i], scene, changed.ligaments[i]);
  return changed;
}

}  // namespace condyle
