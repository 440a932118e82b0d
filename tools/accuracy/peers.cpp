#include "accuracy/peers.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "accuracy/dual.h"
#include "accuracy/peer_libraries.h"

namespace condyle::accuracy {
namespace {

using Jacobian = Eigen::Matrix<double, kUnknowns, kUnknowns>;
using D = Dual<kUnknowns>;

Unknowns<double> linearize(const KneeEquations& equations,
                           const Unknowns<double>& x,
                           Jacobian& jacobian) {
  Unknowns<D> dual;
  for (int i = 0; i < kUnknowns; ++i) dual[i] = D::variable(x[i], i);
  const Unknowns<D> r = equations.residual<D>(dual);
  Unknowns<double> value;
  for (int i = 0; i < kUnknowns; ++i) {
    value[i] = r[i].v;
    jacobian.row(i) = r[i].d.transpose();
  }
  return value;
}

PeerResult newton(const KneeEquations& equations, const Unknowns<double>& start, bool damped) {
  PeerResult result{start, 0, false};
  Jacobian jacobian;
  Unknowns<double> r = linearize(equations, result.x, jacobian);
  while (result.iterations < kMostIterations && r.allFinite()) {
    if (r.cwiseAbs().maxCoeff() < kTolerance) {
      result.converged = true;
      break;
    }
    const Unknowns<double> step = jacobian.partialPivLu().solve(-r);
    double part = 1;
    if (damped)
      while (part > 1e-4 && !(equations.residual<double>(result.x + part * step).norm() < r.norm()))
        part /= 2;
    result.x += part * step;
    r = linearize(equations, result.x, jacobian);
    ++result.iterations;
  }
  return result;
}

PeerResult plain_newton(const KneeEquations& equations, const Unknowns<double>& start) {
  return newton(equations, start, false);
}
PeerResult damped_newton(const KneeEquations& equations, const Unknowns<double>& start) {
  return newton(equations, start, true);
}

#ifdef CONDYLE_HAS_KINSOL
int kinsol_residual(N_Vector x, N_Vector r, void* data) {
  const auto& equations = *static_cast<const KneeEquations*>(data);
  Eigen::Map<Unknowns<double>> out(N_VGetArrayPointer(r));
  out = equations.residual<double>(Eigen::Map<const Unknowns<double>>(N_VGetArrayPointer(x)));
  return out.allFinite() ? 0 : 1;
}

int kinsol_jacobian(N_Vector x, N_Vector, SUNMatrix J, void* data, N_Vector, N_Vector) {
  Jacobian jacobian;
  linearize(*static_cast<const KneeEquations*>(data),
            Eigen::Map<const Unknowns<double>>(N_VGetArrayPointer(x)), jacobian);
  Eigen::Map<Jacobian>(SUNDenseMatrix_Data(J)) = jacobian;
  return 0;
}

PeerResult kinsol(const KneeEquations& equations, const Unknowns<double>& start) {
  KinsolSolver solver(kUnknowns, kinsol_residual, kinsol_jacobian,
                      const_cast<KneeEquations*>(&equations));
  Eigen::Map<Unknowns<double>> x(solver.x());
  x = start;
  const bool converged = solver.solve();
  return {x, solver.iterations(), converged};
}
#endif

#ifdef CONDYLE_HAS_CERES
struct CeresResidual {
  const KneeEquations* equations;
  template <class T>
  bool operator()(const T* x, T* r) const {
    Eigen::Map<Unknowns<T>> out(r);
    out = equations->residual<T>(Eigen::Map<const Unknowns<T>>(x));
    return true;
  }
};

PeerResult ceres_dogleg(const KneeEquations& equations, const Unknowns<double>& start) {
  PeerResult result{start, 0, false};
  ceres::Problem problem;
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<CeresResidual, kUnknowns, kUnknowns>(
                               new CeresResidual{&equations}),
                           nullptr, result.x.data());
  ceres::Solver::Summary summary;
  ceres::Solve(dogleg_options(), &problem, &summary);
  result.iterations = static_cast<int>(summary.iterations.size()) - 1;
  result.converged = std::sqrt(2 * summary.final_cost) < 10 * kTolerance;
  return result;
}
#endif

}  // namespace

std::vector<Peer> peers() {
  std::vector<Peer> all{{"Newton, plain, 17 equations", plain_newton},
                        {"Newton, damped, 17 equations", damped_newton}};
#ifdef CONDYLE_HAS_KINSOL
  all.push_back({"KINSOL, line search", kinsol});
#endif
#ifdef CONDYLE_HAS_CERES
  all.push_back({"Ceres, dogleg", ceres_dogleg});
#endif
  return all;
}

ExactPose solve_exactly(const KneeEquations& equations, const Unknowns<double>& near) {
  Unknowns<long double> x = near.cast<long double>();
  Eigen::Matrix<long double, kUnknowns, kUnknowns> jacobian;
  constexpr long double kStep = 1e-7L;
  for (int iteration = 0; iteration < 12; ++iteration) {
    const Unknowns<long double> r = equations.residual<long double>(x);
    if (iteration > 2 && r.cwiseAbs().maxCoeff() < 1e-15L) break;
    for (int j = 0; j < kUnknowns; ++j) {
      Unknowns<long double> up = x, down = x;
      up[j] += kStep;
      down[j] -= kStep;
      jacobian.col(j) =
          (equations.residual<long double>(up) - equations.residual<long double>(down)) /
          (2 * kStep);
    }
    x -= jacobian.partialPivLu().solve(r);
  }
  const Vec3<long double> turn = x.segment<3>(3);
  return {x.segment<3>(0),
          cayley<long double>(turn) * equations.R0,
          {x[11], x[16]},
          static_cast<double>(equations.residual<long double>(x).cwiseAbs().maxCoeff())};
}

Unknowns<double> unknowns_of(const EquilibriumState& state,
                             const NewtonSystem& system,
                             KneeEquations& equations) {
  equations.R0 = state.X.R.cast<long double>();
  Unknowns<double> x = Unknowns<double>::Zero();
  x.segment<3>(0) = state.X.p;
  x[6] = state.sigma[0];
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    const auto at = 7 + Eigen::Index{5} * state.contacts[k].pair;
    x.segment<3>(at) = system.contacts()[k].B.c;
    x[at + 3] = 1;
    x[at + 4] = state.contacts[k].p;
  }
  return x;
}

double force_error(const KneeEquations& equations,
                   const ExactPose& truth,
                   const RigidTransform& X,
                   const std::array<double, 2>& contacts) {
  long double worst = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    worst = std::max(worst, std::abs(contacts[i] - truth.contacts[i]));
  for (const LineElement& element : equations.model.elements) {
    const Vec3<long double> from = element.x_C.cast<long double>();
    const Vec3<long double> exact = truth.a + truth.R * element.s_D.cast<long double>() - from;
    const double length = (X * element.s_D - element.x_C).norm();
    worst = std::max(worst, std::abs(KneeEquations::tension(element, length) -
                                     KneeEquations::tension(element, exact.norm())));
  }
  return static_cast<double>(worst);
}

std::array<double, 2> contact_forces(const Unknowns<double>& x) { return {x[11], x[16]}; }

std::array<double, 2> contact_forces(const EquilibriumState& state) {
  std::array<double, 2> forces{};
  for (const ClosedContact& contact : state.contacts)
    forces[static_cast<std::size_t>(contact.pair)] += contact.p;
  return forces;
}

RigidTransform pose_of(const KneeEquations& equations, const Unknowns<double>& x) {
  const Vec3<double> turn = x.segment<3>(3);
  return {cayley<double>(turn) * equations.R0.cast<double>(), x.segment<3>(0)};
}

double pose_error(const ExactPose& truth, const RigidTransform& X, double L) {
  const long double moved =
      (X.p.cast<long double>() - truth.a).norm() / static_cast<long double>(L);
  const long double turned = (X.R.cast<long double>() - truth.R).norm() / std::sqrt(2.0L);
  return static_cast<double>(std::max(moved, turned));
}

}  // namespace condyle::accuracy
