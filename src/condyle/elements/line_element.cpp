#include "condyle/elements/line_element.h"

#include <Eigen/Geometry>

#include <variant>

#include "condyle/math/no_number.h"

namespace condyle {
namespace {

/// V = -(α eeᵀ + β I) with α = f' - f/L, β = f/L. With u = q x e, so that eᵀ[q]x = -uᵀ:
///     ∂F/∂a = V                         ∂F/∂π = -V [q]x = -α e uᵀ + β [q]x
///     ∂M/∂a = [q]x V = (∂F/∂π)ᵀ         ∂M/∂π = (q Fᵀ - (q.F) I) - [q]x V [q]x,
///                                       the last product being -α u uᵀ + β (q qᵀ - q² I)
/// Each entry is formed once and added once: the solver spends much of its time here.
void add_derivatives(const Eigen::Vector3d& q,
                     const Eigen::Vector3d& e,
                     const Eigen::Vector3d& F,
                     double alpha,
                     double beta,
                     Wrench& wrench) {
  const Eigen::Vector3d u = q.cross(e), alpha_e = alpha * e, alpha_u = alpha * u;
  const Eigen::Vector3d b = beta * q, turning = F + b;
  Eigen::Matrix3d V = -e * alpha_e.transpose();
  V.diagonal().array() -= beta;
  Eigen::Matrix3d F2 = -e * alpha_u.transpose();
  // clang-format off
                      F2(0, 1) -= b.z();  F2(0, 2) += b.y();
  F2(1, 0) += b.z();                      F2(1, 2) -= b.x();
  F2(2, 0) -= b.y();  F2(2, 1) += b.x();
  // clang-format on
  Eigen::Matrix3d M2 = q * turning.transpose() - u * alpha_u.transpose();
  M2.diagonal().array() -= q.dot(turning);
  wrench.F1 += V;
  wrench.F2 += F2;
  wrench.M1 += F2.transpose();
  wrench.M2 += M2;
}

Tension tension_of_element(const LineElement& element, double length) {
  if (const auto* toe_linear = std::get_if<ToeLinearLaw>(&element.law))
    return tension(*toe_linear, length);
  return tension(element.law, length);
}

/// What a pull of `t` along a path adds whose pull of 1 N is `unit`.
void add_pull(const Tension& t, const Wrench& unit, Wrench& wrench) {
  const Eigen::Vector3d slope_f = t.slope * unit.f, slope_m = t.slope * unit.m;
  wrench.f += t.force * unit.f;
  wrench.m += t.force * unit.m;
  wrench.F1 += t.force * unit.F1 - slope_f * unit.f.transpose();
  wrench.F2 += t.force * unit.F2 - slope_f * unit.m.transpose();
  wrench.M1 += t.force * unit.M1 - slope_m * unit.f.transpose();
  wrench.M2 += t.force * unit.M2 - slope_m * unit.m.transpose();
}

LineElementState add_along_path(const LineElement& element,
                                const RigidTransform& X_BA,
                                double* kept,
                                Wrench& wrench,
                                bool roughly) {
  auto unknown = kept != nullptr ? std::array<double, kMostPathNumbers>() : unknown_path();
  Wrench unit;
  double* numbers = kept != nullptr ? kept : unknown.data();
  const LineEnds ends = ends_of(element, X_BA);
  const double L = roughly ? element.path->pull_roughly(ends, X_BA, numbers, unit)
                           : element.path->pull(ends, X_BA, numbers, unit);
  if (!(L > kLeastLength)) return {L, 0, 0};
  const Tension t = tension_of_element(element, L);
  if (t.force != 0 || t.slope != 0) add_pull(t, unit, wrench);
  return {L, t.force, t.energy};
}

double path_length(const LineElement& element, const RigidTransform& X_BA, double* kept) {
  auto unknown = kept != nullptr ? std::array<double, kMostPathNumbers>() : unknown_path();
  return element.path->length(ends_of(element, X_BA), X_BA,
                              kept != nullptr ? kept : unknown.data());
}

}  // namespace

LineEnds ends_of(const LineElement& element, const RigidTransform& X_BA) {
  const Eigen::Vector3d q = X_BA.R * element.s_D;
  return {element.x_C, X_BA.p + q, q};
}

std::string path_objection(const LineElement& element, const RigidTransform& X_BA) {
  if (!element.path) return {};
  auto kept = unknown_path();
  (void)path_length(element, X_BA, kept.data());
  return element.path->objection(ends_of(element, X_BA), X_BA, kept.data());
}

std::size_t path_numbers(const std::vector<LineElement>& elements) {
  std::size_t numbers = 0;
  for (const LineElement& element : elements)
    if (element.path) numbers += static_cast<std::size_t>(element.path->numbers());
  return numbers;
}

KeptPaths::KeptPaths(const std::vector<LineElement>& elements, std::vector<double>& kept) {
  const std::size_t numbers = path_numbers(elements);
  if (kept.size() != numbers) kept.assign(numbers, kNoNumber);
  next_ = kept.data();
}

LineElementState add_line_element(const LineElement& element,
                                  const RigidTransform& X_BA,
                                  Wrench& wrench,
                                  double* kept,
                                  bool roughly) {
  if (element.path) return add_along_path(element, X_BA, kept, wrench, roughly);
  const Eigen::Vector3d q = X_BA.R * element.s_D;
  const Eigen::Vector3d d = X_BA.p + q - element.x_C;
  const double L = d.norm();
  if (!(L > kLeastLength)) return {L, 0, 0};
  const Tension t = tension_of_element(element, L);
  if (t.force == 0 && t.slope == 0) return {L, 0, t.energy};

  const Eigen::Vector3d e = d / L;
  const Eigen::Vector3d F = -t.force * e;
  const double beta = t.force / L;
  wrench.f += F;
  wrench.m += q.cross(F);
  add_derivatives(q, e, F, t.slope - beta, beta, wrench);
  return {L, t.force, t.energy};
}

LineElementState line_element_state(const LineElement& element,
                                    const RigidTransform& X_BA,
                                    double* kept) {
  const double L =
      element.path ? path_length(element, X_BA, kept) : (X_BA * element.s_D - element.x_C).norm();
  if (!(L > kLeastLength)) return {L, 0, 0};
  const Tension t = tension_of_element(element, L);
  return {L, t.force, t.energy};
}

}  // namespace condyle
