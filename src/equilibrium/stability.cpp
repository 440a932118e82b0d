#include "equilibrium/stability.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <limits>

namespace condyle {

Stability stability(const Model& model, const NewtonSystem& system) {
  using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
  const double L = model.length;
  const Wrench& w = system.wrench();
  Eigen::Matrix<double, 6, 6> K;
  K << w.F1, w.F2 / L, w.M1 / L, w.M2 / (L * L);
  K = (-0.5 * (K + K.transpose())).eval();

  const auto rows =
      static_cast<Eigen::Index>(system.contacts().size() + system.conditions().size());
  SmallMatrix columns(6, std::min<Eigen::Index>(rows, 6));
  Eigen::Index k = 0;
  for (const ContactLinearization& contact : system.contacts())
    if (k < columns.cols()) columns.col(k++) << contact.B.n, contact.arm / L;
  for (const ConditionDerivatives& condition : system.conditions())
    if (k < columns.cols()) columns.col(k++) << condition.alpha, condition.eta / L;
  // Conditions on lengths and on angles differ in size: only their directions matter here.
  for (Eigen::Index j = 0; j < columns.cols(); ++j) columns.col(j).normalize();

  Stability result{std::numeric_limits<double>::infinity(), Eigen::Matrix<double, 6, 1>::Zero()};
  if (columns.cols() == 6) return result;
  SmallMatrix Z = SmallMatrix::Identity(6, 6);
  if (columns.cols() > 0) {
    const Eigen::HouseholderQR<SmallMatrix> qr(columns);
    const SmallMatrix Q = qr.householderQ() * SmallMatrix::Identity(6, 6);
    Z = Q.rightCols(6 - columns.cols());
  }
  const SmallMatrix reduced = Z.transpose() * K * Z;
  if (!reduced.allFinite()) return result;
  const Eigen::SelfAdjointEigenSolver<SmallMatrix> eigen(reduced);
  result.lowest_stiffness = eigen.eigenvalues()[0];
  result.motion = Z * eigen.eigenvectors().col(0);
  return result;
}

}  // namespace condyle
