#include "accuracy/condensed_peers.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "accuracy/knee_equations.h"
#include "accuracy/peer_libraries.h"
#include "condyle/contact/contact_search.h"
#include "condyle/contact/settle_places.h"

namespace condyle::accuracy {
namespace {

constexpr int kSize = 9;  // da, turn, two contact forces, one multiplier

using Numbers = Eigen::Matrix<double, kSize, 1>;
using Square = Eigen::Matrix<double, kSize, kSize>;

/// The equations as a function of x = (a - a0, L g, p, σ/w), R = cayley(g) R0.
class CondensedKnee {
 public:
  explicit CondensedKnee(const Model& model) : model_(model), system_(model) {}

  /// Returns the unknowns of the start.
  Numbers begin(const EquilibriumState& start, const Drive& drive) {
    start_ = state_ = start;
    drive_ = drive;
    Numbers x = Numbers::Zero();
    for (int k = 0; k < 2; ++k) x[6 + k] = start.contacts[k].p;
    x[8] = start.sigma[0] / condition_weight(model_, 0);
    evaluated_ = false;
    return x;
  }

  /// Residual and matrix there; false where they do not exist.
  bool evaluate(const Eigen::Ref<const Numbers>& x) {
    if (evaluated_ && x == x_) return good_;
    x_ = x;
    evaluated_ = true;
    const Eigen::Vector3d g = x.segment<3>(3) / model_.length;
    state_.X.p = start_.X.p + x.head<3>();
    state_.X.R = cayley<double>(g) * start_.X.R;
    state_.sigma[0] = x[8] * condition_weight(model_, 0);
    good_ = true;
    for (int k = 0; k < 2; ++k) {
      ClosedContact& contact = state_.contacts[k];
      contact.p = x[6 + k];
      ContactLinearization at;
      good_ = good_ && settle_places(model_.pairs[contact.pair], state_.X, {model_.length, true},
                                     contact.places, at) == Settled::kThere;
    }
    good_ = good_ && system_.assemble(state_, drive_);
    if (!good_) {
      for (int k = 0; k < 2; ++k) state_.contacts[k] = start_.contacts[k];
      return false;
    }
    Numbers minus_r;
    system_.fill(state_, matrix_, minus_r.data());
    r_ = -minus_r;
    // dπ = (I + [g]x/2) dg 4/(4 + g²)
    Eigen::Matrix3d turn;
    turn << 1, -g.z() / 2, g.y() / 2, g.z() / 2, 1, -g.x() / 2, -g.y() / 2, g.x() / 2, 1;
    turn *= 4 / (4 + g.squaredNorm());
    for (int i = 0; i < kSize; ++i)
      for (int j = 0; j < kSize; ++j) J_(i, j) = matrix_(i, j);
    J_.middleCols<3>(3) = (J_.middleCols<3>(3) * turn).eval();
    return true;
  }

  [[nodiscard]] const Numbers& residual() const { return r_; }
  [[nodiscard]] const Square& jacobian() const { return J_; }
  [[nodiscard]] const EquilibriumState& state() const { return state_; }

 private:
  const Model& model_;
  NewtonSystem system_;
  EquilibriumState start_, state_;
  Drive drive_;
  SmallLu matrix_;
  Numbers x_, r_;
  Square J_;
  bool evaluated_ = false, good_ = false;
};

/// What a solver ended with.
CondensedResult result_at(CondensedKnee& knee, const Numbers& x, int iterations) {
  const bool good = knee.evaluate(x);
  return {knee.state(), iterations,
          good && knee.residual().cwiseAbs().maxCoeff() < 10 * kTolerance};
}

#ifdef CONDYLE_HAS_KINSOL
int kinsol_residual(N_Vector x, N_Vector r, void* data) {
  auto& knee = *static_cast<CondensedKnee*>(data);
  if (!knee.evaluate(Eigen::Map<const Numbers>(N_VGetArrayPointer(x)))) return 1;
  Eigen::Map<Numbers>(N_VGetArrayPointer(r)) = knee.residual();
  return 0;
}

int kinsol_jacobian(N_Vector x, N_Vector, SUNMatrix J, void* data, N_Vector, N_Vector) {
  auto& knee = *static_cast<CondensedKnee*>(data);
  if (!knee.evaluate(Eigen::Map<const Numbers>(N_VGetArrayPointer(x)))) return 1;
  Eigen::Map<Square>(SUNDenseMatrix_Data(J)) = knee.jacobian();
  return 0;
}

class Kinsol {
 public:
  explicit Kinsol(const Model& model)
      : knee_(model), solver_(kSize, kinsol_residual, kinsol_jacobian, &knee_) {}
  Kinsol(const Kinsol&) = delete;
  Kinsol& operator=(const Kinsol&) = delete;

  CondensedResult solve(const EquilibriumState& start, const Drive& drive) {
    Eigen::Map<Numbers> x(solver_.x());
    x = knee_.begin(start, drive);
    solver_.solve();
    return result_at(knee_, x, solver_.iterations());
  }

 private:
  CondensedKnee knee_;
  KinsolSolver solver_;
};
#endif

#ifdef CONDYLE_HAS_CERES
class CeresResidual : public ceres::SizedCostFunction<kSize, kSize> {
 public:
  explicit CeresResidual(CondensedKnee& knee) : knee_(knee) {}
  bool Evaluate(const double* const* x, double* r, double** jacobians) const override {
    if (!knee_.evaluate(Eigen::Map<const Numbers>(x[0]))) return false;
    Eigen::Map<Numbers>{r} = knee_.residual();
    if (jacobians != nullptr && jacobians[0] != nullptr)
      Eigen::Map<Eigen::Matrix<double, kSize, kSize, Eigen::RowMajor>>{jacobians[0]} =
          knee_.jacobian();
    return true;
  }

 private:
  CondensedKnee& knee_;
};

/// Ceres has no tolerance of the residual itself.
class StopAtTolerance : public ceres::IterationCallback {
 public:
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    return std::sqrt(2 * summary.cost) < kTolerance ? ceres::SOLVER_TERMINATE_SUCCESSFULLY
                                                    : ceres::SOLVER_CONTINUE;
  }
};

class Ceres {
 public:
  explicit Ceres(const Model& model) : knee_(model) {
    problem_.AddResidualBlock(new CeresResidual(knee_), nullptr, x_.data());
    options_.callbacks.push_back(&stop_);
  }

  CondensedResult solve(const EquilibriumState& start, const Drive& drive) {
    x_ = knee_.begin(start, drive);
    ceres::Solver::Summary summary;
    ceres::Solve(options_, &problem_, &summary);
    return result_at(knee_, x_, static_cast<int>(summary.iterations.size()) - 1);
  }

 private:
  CondensedKnee knee_;
  Numbers x_;
  StopAtTolerance stop_;
  ceres::Problem problem_;
  ceres::Solver::Options options_ = dogleg_options();
};
#endif

template <class Solver>
CondensedPeer peer(const char* name, const Model& model) {
  const auto solver = std::make_shared<Solver>(model);
  return {name, [solver](const EquilibriumState& start, const Drive& drive) {
            return solver->solve(start, drive);
          }};
}

}  // namespace

std::vector<CondensedPeer> condensed_peers([[maybe_unused]] const Model& model) {
  std::vector<CondensedPeer> all;
#ifdef CONDYLE_HAS_KINSOL
  all.push_back(peer<Kinsol>("KINSOL, line search, condensed, derivatives by hand", model));
#endif
#ifdef CONDYLE_HAS_CERES
  all.push_back(peer<Ceres>("Ceres, dogleg, condensed, derivatives by hand", model));
#endif
  return all;
}

}  // namespace condyle::accuracy
