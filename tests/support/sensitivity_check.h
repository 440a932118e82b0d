#pragma once

/// Derivatives of solved poses against differences of poses that are solved anew.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "condyle/contact/layer_contact.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/equilibrium/sensitivity.h"

namespace condyle::test {

/// Newton as exact as it gets: differences divide its error by their step.
inline EquilibriumOptions for_differences() {
  EquilibriumOptions options;
  options.newton.tolerance = 1e-14;
  options.description.stability = false;
  return options;
}

/// A model with its drive, and of which layers its pairs are.
struct Studied {
  Model model;
  Drive drive;
  LayerOptions layer = {};
};

/// All that a pose of the model tells.
inline std::vector<PoseOutput> all_outputs(const Linearization& at, const PoseResult& pose) {
  std::vector<PoseOutput> outputs;
  const auto add = [&outputs](OutputKind kind, std::size_t index, std::size_t point = 0) {
    outputs.push_back({kind, index, 0, point});
  };
  const auto add_vector = [&outputs](OutputKind kind, std::size_t index, std::size_t point = 0) {
    for (const int component : {0, 1, 2}) outputs.push_back({kind, index, component, point});
  };
  for (std::size_t i = 0; i < 6 && at.model.joint; ++i) add(OutputKind::kJointCoordinate, i);
  for (std::size_t i = 0; i < pose.contacts.size(); ++i) {
    add(OutputKind::kContactForce, i);
    if (!pose.contacts[i].closed) continue;
    add_vector(OutputKind::kContactResultant, i);
    if (pose.contacts[i].layer) {
      add_vector(OutputKind::kLayerForce, i);
      add_vector(OutputKind::kLayerMoment, i);
      continue;
    }
    for (std::size_t point = 0; point < pose.contacts[i].points.size(); ++point) {
      add(OutputKind::kPointForce, i, point);
      add_vector(OutputKind::kPointGround, i, point);
      add_vector(OutputKind::kPointMoving, i, point);
    }
  }
  for (std::size_t i = 0; i < pose.ligaments.size(); ++i)
    for (const OutputKind kind :
         {OutputKind::kLigamentLength, OutputKind::kLigamentStrain, OutputKind::kLigamentForce})
      add(kind, i);
  for (std::size_t i = 0; i < pose.conditions.size(); ++i) add(OutputKind::kMultiplier, i);
  return outputs;
}

/// All parameters that the model has; insertions of every `each`th ligament.
inline std::vector<ModelParameter> all_parameters(const Studied& knee, std::size_t each = 1) {
  std::vector<ModelParameter> all;
  const Model& model = knee.model;
  const Parameters parameters = parameters_of(model);
  const auto add = [&](const ModelParameter& parameter) {
    try {
      check_parameter(parameter, model, parameters);
      all.push_back(parameter);
    } catch (const std::invalid_argument&) {  // the model has none
    }
  };
  const auto add_vector = [&](ModelParameter parameter) {
    for (const int component : {0, 1, 2}) {
      parameter.component = component;
      add(parameter);
    }
  };
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    for (const ParameterKind kind : {ParameterKind::kReferenceStrain, ParameterKind::kSlackLength,
                                     ParameterKind::kStiffness, ParameterKind::kTransitionStrain})
      add({kind, i});
    if (i % each != 0) continue;
    for (const OfBody body : {OfBody::kFixed, OfBody::kMoving})
      for (const Held held : {Held::kSlackLength, Held::kReferenceStrain})
        add_vector({ParameterKind::kInsertion, i, body, 0, held});
  }
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    add({ParameterKind::kLoadScale, i});
    add_vector({ParameterKind::kLoadVector, i});
    add_vector({ParameterKind::kLoadPoint, i});
  }
  for (std::size_t i = 0; i < model.conditions.size(); ++i)
    add({ParameterKind::kConditionValue, i});
  for (std::size_t i = 0; i < model.pairs.size(); ++i) {
    for (const OfBody body : {OfBody::kFixed, OfBody::kMoving})
      add_vector({ParameterKind::kSurfaceShift, i, body});
    for (const OfBody body : {OfBody::kFixed, OfBody::kMoving, OfBody::kBoth})
      add({ParameterKind::kLayerModulus, i, body});
  }
  return all;
}

/// A surface moved wherever it is used, or a layer with another modulus.
inline Model changed_surfaces(const Studied& knee, const ModelParameter& parameter, double by) {
  Model model = knee.model;
  const bool on_A = parameter.body == OfBody::kMoving;
  ContactPair& pair = model.pairs[parameter.index];
  if (parameter.kind == ParameterKind::kSurfaceShift) {
    const std::shared_ptr<const Surface> before = on_A ? pair.on_A : pair.on_B;
    const std::shared_ptr<const Surface> after =
        before->translated(by * Eigen::Vector3d::Unit(parameter.component));
    for (ContactPair& other : model.pairs)
      for (auto member : {&ContactPair::on_B, &ContactPair::on_A})
        if (other.*member == before) other.*member = after;
  } else {
    if (!(parameter.body == OfBody::kMoving) && pair.elastic_B) pair.elastic_B->modulus *= 1 + by;
    if (!(parameter.body == OfBody::kFixed) && pair.elastic_A) pair.elastic_A->modulus *= 1 + by;
  }
  for (ContactPair& other : model.pairs)
    if (other.law) other.law = layer_contact(knee.layer, model.origins.B);
  return model;
}

/// Poses of the model with one parameter changed, from the solved one. `covers` of its surfaces.
class Perturbed {
 public:
  Perturbed(const Studied& knee, const ContactCovers& covers, const EquilibriumState& solution)
      : knee_(knee),
        shared_(std::make_shared<const Model>(knee.model)),
        state_(solution),
        solver_(shared_, covers, for_differences()) {}

  PoseResult pose(const ModelParameter& parameter, double by) {
    if (parameter.kind == ParameterKind::kSurfaceShift ||
        parameter.kind == ParameterKind::kLayerModulus) {
      Model model = changed_surfaces(knee_, parameter, by);
      model.start = state_.X;
      const auto changed = std::make_shared<const Model>(std::move(model));
      const bool moved = parameter.kind == ParameterKind::kSurfaceShift;
      EquilibriumSolver solver(changed, moved ? cover_pairs(*changed) : solver_.covers(),
                               for_differences());
      return solver.solve(knee_.drive);
    }
    Parameters parameters = parameters_of(knee_.model);
    Drive drive = knee_.drive;
    change(parameter, by, knee_.model, parameters, drive);
    solver_.set_parameters(parameters);
    solver_.set_state(state_, knee_.drive);
    return solver_.solve(drive);
  }

 private:
  const Studied& knee_;
  std::shared_ptr<const Model> shared_;
  EquilibriumState state_;
  EquilibriumSolver solver_;
};

/// Step of a difference.
inline double step_of(const ModelParameter& parameter, const Studied& knee) {
  switch (parameter.kind) {
    case ParameterKind::kReferenceStrain:
    case ParameterKind::kTransitionStrain:
      return 1e-4;
    case ParameterKind::kStiffness: {
      const ForceLaw& law = knee.model.elements[parameter.index].law;
      const auto* toe = std::get_if<ToeLinearLaw>(&law);
      return 1e-3 * (toe != nullptr ? toe->stiffness : std::get<QuadraticLaw>(law).stiffness);
    }
    case ParameterKind::kLoadScale:
    case ParameterKind::kLayerModulus:
      return 1e-3;
    case ParameterKind::kLoadVector:
      return knee.model.loads[parameter.index].moment ? 1 : 0.1;
    case ParameterKind::kConditionValue:
      return is_angle(knee.model.conditions[parameter.index].kind) ? 1e-4 : 3e-3;
    default:
      return 3e-3;  // mm
  }
}

/// Outputs that are compared with each other: as large as the largest of them.
inline int group_of(const PoseOutput& output) {
  const bool translation = output.kind == OutputKind::kJointCoordinate && output.index > 2;
  return translation ? -1 : static_cast<int>(output.kind);
}

/// Of one column, by differences of fourth order.
inline std::vector<double> column_by_differences(Perturbed& perturbed,
                                                 const std::vector<PoseOutput>& outputs,
                                                 const ModelParameter& parameter,
                                                 double h,
                                                 std::string& failed) {
  std::vector<double> column(outputs.size(), 0.0);
  for (const auto& [steps, weight] :
       {std::pair{1, 8.0}, std::pair{-1, -8.0}, std::pair{2, -1.0}, std::pair{-2, 1.0}}) {
    const PoseResult pose = perturbed.pose(parameter, steps * h);
    if (!pose.converged()) failed = pose.reason + pose.remark;
    for (std::size_t i = 0; i < outputs.size() && failed.empty(); ++i)
      column[i] += weight * value_of(outputs[i], pose) / (12 * h);
  }
  return column;
}

/// The greatest difference of a column by groups of outputs, relative to the greatest entry of the
/// group; what round-off of outputs as great as `pose` has them leaves is none.
inline std::pair<double, std::string> worst_of_column(const std::vector<double>& found,
                                                      const std::vector<double>& expected,
                                                      const std::vector<PoseOutput>& outputs,
                                                      const PoseResult& pose,
                                                      double h) {
  constexpr double kRoundOff = 1e-12;
  std::map<int, double> greatest, scale;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    double& entry = greatest[group_of(outputs[i])];
    entry = std::max(entry, std::abs(expected[i]));
    double& value = scale[group_of(outputs[i])];
    value = std::max({value, std::abs(value_of(outputs[i], pose)), 1e-3});
  }
  std::pair<double, std::string> worst{0, ""};
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const int group = group_of(outputs[i]);
    const double off =
        std::max(0.0, std::abs(found[i] - expected[i]) - kRoundOff * scale[group] / h);
    const double relative = greatest[group] > 0 ? off / greatest[group] : off;
    if (relative <= worst.first) continue;
    worst = {relative, "output " + std::to_string(static_cast<int>(outputs[i].kind)) + " of " +
                           std::to_string(outputs[i].index) + ", " +
                           std::to_string(outputs[i].component) + ": " + std::to_string(found[i]) +
                           ", by differences " + std::to_string(expected[i])};
  }
  return worst;
}

/// The solved pose and its derivatives.
struct Solved {
  explicit Solved(const Studied& knee)
      : solver(std::make_shared<const Model>(knee.model), for_differences()),
        pose(solver.solve(knee.drive)),
        sensitivity(solver.model()) {
    EXPECT_TRUE(pose.converged()) << pose.reason;
    EXPECT_TRUE(sensitivity.set(at()));
  }
  [[nodiscard]] Linearization at() const { return solver.linearized_solution(); }
  [[nodiscard]] std::vector<PoseOutput> outputs() const { return all_outputs(at(), pose); }

  EquilibriumSolver solver;
  PoseResult pose;
  Sensitivity sensitivity;
};

inline std::vector<double> column_of(const Eigen::MatrixXd& J, std::size_t j) {
  const Eigen::VectorXd column = J.col(static_cast<Eigen::Index>(j));
  return {column.begin(), column.end()};
}

/// Every column against differences. `h`: a part of the usual steps.
inline void expect_exact(const Studied& knee,
                         std::size_t each = 1,
                         double tolerance = 1e-6,
                         double h = 1) {
  Solved solved(knee);
  const std::vector<PoseOutput> outputs = solved.outputs();
  const std::vector<ModelParameter> parameters = all_parameters(knee, each);
  Eigen::MatrixXd J;
  solved.sensitivity.derivatives(outputs, parameters, J);
  Perturbed perturbed(knee, solved.solver.covers(), solved.solver.solution());
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const std::string name = name_of(parameters[j], knee.model);
    const double step = h * step_of(parameters[j], knee);
    std::string failed;
    const std::vector<double> expected =
        column_by_differences(perturbed, outputs, parameters[j], step, failed);
    ASSERT_EQ(failed, "") << name;
    const auto [off, where] =
        worst_of_column(column_of(J, j), expected, outputs, solved.pose, step);
    EXPECT_LT(off, tolerance) << name << ": " << where;
  }
}

/// Every column of two matrices by groups of outputs, where round-off in what the model's numbers are
/// `larger` times is none.
inline void expect_same(const Eigen::MatrixXd& A,
                        const Eigen::MatrixXd& B,
                        const Studied& knee,
                        const std::vector<PoseOutput>& outputs,
                        const std::vector<ModelParameter>& parameters,
                        const PoseResult& pose,
                        double larger,
                        double tolerance) {
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const double step = step_of(parameters[j], knee) / (3e-3 * larger);
    const auto [off, where] =
        worst_of_column(column_of(A, j), column_of(B, j), outputs, pose, step);
    EXPECT_LT(off, tolerance) << name_of(parameters[j], knee.model) << ": " << where;
  }
}

}  // namespace condyle::test
