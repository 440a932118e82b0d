/// The quadratic programme of a step of the descent: energy, conditions and gaps to first order,
/// and what the forces of the contacts add to second.

#include <algorithm>
#include <cmath>

#include "condyle/elements/surely_slack.h"
#include "condyle/equilibrium/descent.h"

namespace condyle {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kCompliance = 1e-8;      // of the constraints, relative
constexpr double kLeastForce = 1e-12;     // [N]: no scale is zero where nothing pulls
constexpr double kLooseness = 3;          // L over which the forces alone make a stiffness
constexpr double kLeastStiffness = 1e-4;  // of the greatest: eigenvalues of the programme's matrix

/// Symmetric part of -∂wrench in scaled components [N/mm].
Matrix6 symmetric_stiffness(const Wrench& w, double L) {
  const Matrix6 K = scaled_stiffness(w, L);
  return 0.5 * (K + K.transpose());
}

}  // namespace

void Descent::set_forces(Programme& programme) {
  const double L = model_.length;
  Wrench wrench;
  programme.force_scale = kLeastForce;
  KeptPaths kept(parameters().elements, paths_);
  for (const LineElement& element : parameters().elements) {
    double* numbers = kept.of(element);
    if (is_surely_slack(element, X_, numbers)) continue;
    programme.force_scale += std::abs(add_line_element(element, X_, wrench, numbers).force);
  }
  for (std::size_t i = 0; i < parameters().loads.size(); ++i) {
    const Vector6 before = scaled_wrench(wrench, L);
    add_load(parameters().loads[i], drive_->scales[i], X_, wrench);
    programme.force_scale += (scaled_wrench(wrench, L) - before).norm();
  }
  programme.force_scale += newton_.system().potentials().add_to(X_, wrench);
  SmallQp& qp = programme.qp;
  qp.H = symmetric_stiffness(wrench, L);
  qp.g = -scaled_wrench(wrench, L);
  programme.stiffness_scale =
      std::max(qp.H.cwiseAbs().maxCoeff(), programme.force_scale / (kLooseness * L));
  qp.floor = kLeastStiffness * programme.stiffness_scale;
  qp.compliance = kCompliance;
}

void Descent::set_rows(Programme& programme) const {
  for (std::size_t k = 0; k < constraints_.size(); ++k)
    (constraints_[k].bilateral ? programme.two_sided : programme.one_sided).push_back(k);
  const auto m = static_cast<Eigen::Index>(model_.conditions.size());
  SmallQp& qp = programme.qp;
  qp.C.resize(m + static_cast<Eigen::Index>(programme.two_sided.size()), 6);
  qp.b.resize(qp.C.rows());
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const ConditionDerivatives k = condition(index, X_);
    const double w = condition_weight(model_, index);
    qp.C.row(i) << w * k.alpha.transpose(), w * k.eta.transpose() / model_.length;
    qp.b[i] = -w * k.k;
  }
  Eigen::Index row = m;
  for (const std::size_t k : programme.two_sided) {
    qp.C.row(row) = constraints_[k].row.transpose();
    qp.b[row++] = -constraints_[k].gap;
  }
  qp.A.resize(static_cast<Eigen::Index>(programme.one_sided.size()), 6);
  qp.d.resize(qp.A.rows());
  row = 0;
  for (const std::size_t k : programme.one_sided) {
    qp.A.row(row) = constraints_[k].row.transpose();
    qp.d[row++] = -constraints_[k].gap;
  }
}

/// -p times the second derivative of each gap that carries: how a curved contact yields when the
/// pose tilts.
bool Descent::add_contact_curvature(Programme& programme, const SmallQpSolution& solution) const {
  bool added = false;
  for (std::size_t j = 0; j < programme.one_sided.size(); ++j) {
    const Constraint& constraint = constraints_[programme.one_sided[j]];
    const double p = solution.lambda[static_cast<Eigen::Index>(j)];
    if (p <= 0 || !constraint.refined) continue;
    Wrench of_contact;
    add_contact_force(linearize_contact(model_.pairs[constraint.pair], constraint.places, X_), p,
                      of_contact);
    const Matrix6 K = symmetric_stiffness(of_contact, model_.length);
    if (!K.allFinite()) continue;
    programme.qp.H += K;
    added = true;
  }
  return added;
}

Descent::Multipliers Descent::multipliers(const Programme& programme,
                                          const SmallQpSolution& solution) const {
  Multipliers forces;
  forces.p.assign(constraints_.size(), 0);
  for (std::size_t j = 0; j < programme.one_sided.size(); ++j)
    forces.p[programme.one_sided[j]] = solution.lambda[static_cast<Eigen::Index>(j)];
  const std::size_t m = model_.conditions.size();
  for (std::size_t j = 0; j < programme.two_sided.size(); ++j)
    forces.p[programme.two_sided[j]] = solution.nu[static_cast<Eigen::Index>(m + j)];
  for (std::size_t i = 0; i < m; ++i) {
    const double nu = solution.nu[static_cast<Eigen::Index>(i)];
    forces.sigma.push_back(-nu * condition_weight(model_, i));
    forces.largest = std::max(forces.largest, std::abs(nu));
  }
  for (const double p : forces.p) forces.largest = std::max(forces.largest, std::abs(p));
  return forces;
}

}  // namespace condyle
