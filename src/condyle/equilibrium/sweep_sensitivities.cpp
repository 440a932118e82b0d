#include "condyle/equilibrium/sweep_sensitivities.h"

#include <numbers>
#include <span>
#include <stdexcept>
#include <utility>

#include "condyle/elements/joint_table.h"
#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/restore_state.h"
#include "condyle/equilibrium/sensitivity.h"
#include "condyle/math/no_number.h"

namespace condyle {
namespace {

std::vector<ModelParameter> parts_of(const std::vector<SceneParameter>& parameters) {
  std::vector<ModelParameter> all;
  for (const SceneParameter& parameter : parameters)
    all.insert(all.end(), parameter.parts.begin(), parameter.parts.end());
  return all;
}

std::vector<PoseOutput> rows_of(const std::vector<SensitivityOutput>& outputs) {
  std::vector<PoseOutput> rows;
  for (const SensitivityOutput& output : outputs) rows.push_back(output.output);
  return rows;
}

std::string names_of(const std::vector<OneSidedContact>& contacts, const Model& model) {
  std::string names;
  for (const OneSidedContact& contact : contacts)
    names += (names.empty() ? "" : ", ") + model.pairs[contact.pair].name;
  return names;
}

/// Of one model, pose by pose.
class PoseSensitivities {
 public:
  PoseSensitivities(const Model& model, const Swept& swept, const SweepSensitivities& asked)
      : model_(model),
        swept_(swept),
        parameters_(asked.parameters),
        outputs_(rows_of(asked.outputs)),
        parts_(parts_of(asked.parameters)),
        newton_(model),
        sensitivity_(model) {}

  /// NaN where there are none.
  Eigen::MatrixXd at(const PoseResult& pose, std::string& one_sided) {
    Eigen::MatrixXd J =
        Eigen::MatrixXd::Constant(static_cast<Eigen::Index>(outputs_.size()),
                                  static_cast<Eigen::Index>(parameters_.size()), kNoNumber);
    if (!pose.converged() || !can_restore(model_, pose)) return J;
    EquilibriumState state = restore_state(model_, pose);
    const Drive drive = swept_.with(drive_of(model_), pose.value);
    if (newton_.solve(state, drive).outcome != NewtonOutcome::kConverged) return J;
    const Linearization at = linearization(newton_.system(), state, drive);
    if (!sensitivity_.set(at)) return J;
    differentiate();
    add_up(J);
    one_sided = names_of(one_sided_contacts(at, pose), model_);
    return J;
  }

 private:
  /// Of all parts at once; where some have none, one by one, NaN in the columns of those.
  void differentiate() {
    try {
      sensitivity_.derivatives(outputs_, parts_, by_parts_);
    } catch (const std::invalid_argument&) {
      by_parts_.setConstant(static_cast<Eigen::Index>(outputs_.size()),
                            static_cast<Eigen::Index>(parts_.size()), kNoNumber);
      for (std::size_t k = 0; k < parts_.size(); ++k) differentiate_by(k);
    }
  }
  void differentiate_by(std::size_t part) {
    Eigen::MatrixXd column;
    try {
      sensitivity_.derivatives(outputs_, std::span(&parts_[part], 1), column);
      by_parts_.col(static_cast<Eigen::Index>(part)) = column;
    } catch (const std::invalid_argument&) {  // it stays none
    }
  }

  void add_up(Eigen::MatrixXd& J) const {
    J.setZero();
    Eigen::Index part = 0;
    for (std::size_t j = 0; j < parameters_.size(); ++j)
      for (std::size_t k = 0; k < parameters_[j].parts.size(); ++k)
        J.col(static_cast<Eigen::Index>(j)) += by_parts_.col(part++);
  }

  const Model& model_;
  Swept swept_;
  const std::vector<SceneParameter>& parameters_;
  std::vector<PoseOutput> outputs_;
  std::vector<ModelParameter> parts_;
  Newton newton_;
  Sensitivity sensitivity_;
  Eigen::MatrixXd by_parts_;
};

}  // namespace

std::vector<SensitivityOutput> sensitivity_outputs(const Scene& scene) {
  const Unit degree{"deg", std::numbers::pi / 180}, millimetre{"mm", 1}, newton{"N", 1},
      moment{"N mm", 1};
  std::vector<SensitivityOutput> outputs;
  for (std::size_t i = 0; scene.joint && i < kJointCoordinates.size(); ++i)
    outputs.push_back({std::string("joint/") + kJointCoordinates[i].name,
                       kJointCoordinates[i].angle ? degree : millimetre,
                       {OutputKind::kJointCoordinate, i}});
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    outputs.push_back(
        {"contacts/" + scene.contacts[i].name + "/force", newton, {OutputKind::kContactForce, i}});
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
    outputs.push_back({"ligaments/" + scene.ligaments[i].name + "/force",
                       newton,
                       {OutputKind::kLigamentForce, i}});
  for (std::size_t i = 0; i < scene.conditions.size(); ++i)
    outputs.push_back({"conditions/" + scene.conditions[i].name + "/multiplier",
                       is_angle(scene.conditions[i].kind) ? moment : newton,
                       {OutputKind::kMultiplier, i}});
  return outputs;
}

std::shared_ptr<const SweepSensitivities> sweep_sensitivities(
    const Scene& scene,
    const std::vector<FittedSurface>& surfaces,
    const std::vector<PoseResult>& poses) {
  if (!scene.sweep || scene.sweep->sensitivities.empty()) return nullptr;
  const auto found = std::make_shared<SweepSensitivities>();
  found->outputs = sensitivity_outputs(scene);
  found->parameters = scene_parameters(scene, scene.sweep->sensitivities);
  const Model model = build_model(scene, surfaces);
  PoseSensitivities sensitivities(model, swept_of(*scene.sweep), *found);
  for (const PoseResult& pose : poses)
    found->by_pose.push_back(sensitivities.at(pose, found->one_sided.emplace_back()));
  return found;
}

}  // namespace condyle
