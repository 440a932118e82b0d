#pragma once

/// How a solved pose changes with the numbers of its model: derivatives of outputs (pose_output.h)
/// with respect to parameters (model_parameter.h) at a position of equilibrium.
///
/// With Newton's matrix M and the column F_p of a parameter at a fixed state, dx/dp = -M⁻¹ F_p: one
/// factorisation for all parameters, one back substitution for each. It is exact, because residual and
/// gaps vanish. For fewer outputs than parameters, with the row g_x and the explicit part g_p of an
/// output, Mᵀ λ = g_x and dg/dp = g_p - λᵀ F_p.
///
/// Derivatives are those with the closed contacts kept closed and the open ones open: one-sided where
/// a contact is about to open or to close (one_sided_contacts), or a line comes to lie on a surface.
/// An element at its slack length is none: its force has a continuous slope.

#include <span>

#include "condyle/equilibrium/pose_output.h"
#include "condyle/math/small_lu.h"

namespace condyle {

/// dx/dp of what Newton solves for, per unit of the parameter.
struct StateRate {
  Eigen::Vector3d da, dpi;                      ///< of the pose in the model's frames [mm], [rad]
  std::array<double, kMaxConstraints> p{};      ///< of the contact forces [N]
  std::array<double, kMaxConstraints> sigma{};  ///< of the multipliers [N] or [N mm]
};

/// Workspace of one thread; allocates nothing once it was used with as many outputs.
class Sensitivity {
 public:
  explicit Sensitivity(const Model& model);

  /// At a position of equilibrium (EquilibriumSolver::linearized_solution), which is referred to until
  /// the next one is set. False where there are no derivatives: Newton's matrix is singular, at a limit
  /// point, where nothing resists a motion, where constraints depend on each other.
  bool set(const Linearization& at);

  // All that follow throw std::invalid_argument with one sentence as find_effect and find_row do, and
  // std::logic_error where set has said false or was not called.

  [[nodiscard]] StateRate state_rate(const ModelParameter& parameter);
  [[nodiscard]] double derivative(const PoseOutput& output, const ModelParameter& parameter);

  enum class Way { kForward, kAdjoint, kCheaper };
  /// Row i, column j: output i by parameter j.
  void derivatives(std::span<const PoseOutput> outputs,
                   std::span<const ModelParameter> parameters,
                   Eigen::MatrixXd& J,
                   Way way = Way::kCheaper);

 private:
  void check_set() const;
  void find_step(const ModelParameter& parameter);
  [[nodiscard]] double product(const OutputRow& row, const OutputRow& with) const;

  LocalRates rates_;
  SmallLu matrix_;
  int size_ = 0;  ///< of the matrix; 0: none
  ParameterEffect effect_;
  OutputRow step_{};
  std::vector<OutputRow> rows_;
};

/// Contacts of a pose where derivatives are those of one side.
struct OneSidedContact {
  std::size_t pair;
  bool closed;  ///< at zero force, about to open; else open at zero gap, about to close
};

/// Of contacts that open and close by themselves: closed ones whose force is below 1e-9 of the sum of
/// all forces, open ones whose nearest gap is below 1e-6 L/30. `pose` as told at that linearization.
[[nodiscard]] std::vector<OneSidedContact> one_sided_contacts(const Linearization& at,
                                                              const PoseResult& pose);

}  // namespace condyle
