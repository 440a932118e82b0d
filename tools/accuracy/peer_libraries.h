#pragma once

/// KINSOL and Ceres set up as a peer, each where it was found when this was built, whatever the equations.

#ifdef CONDYLE_HAS_CERES
#include <ceres/ceres.h>
#endif
#ifdef CONDYLE_HAS_KINSOL
#include <kinsol/kinsol.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#endif

namespace condyle::accuracy {

inline constexpr int kMostIterations = 200;
inline constexpr double kTolerance = 1e-9;  ///< of the residual [N]: 1e-12 of the forces

#ifdef CONDYLE_HAS_KINSOL
/// Line search with a Jacobian of its own at every step.
class KinsolSolver {
 public:
  /// `data` is handed on to both functions.
  KinsolSolver(int size, KINSysFn residual, KINLsJacFn jacobian, void* data) {
    SUNContext_Create(nullptr, &context_);
    x_ = N_VNew_Serial(size, context_);
    ones_ = N_VNew_Serial(size, context_);
    N_VConst(1, ones_);
    J_ = SUNDenseMatrix(size, size, context_);
    linear_ = SUNLinSol_Dense(x_, J_, context_);
    memory_ = KINCreate(context_);
    KINSetErrFile(memory_, nullptr);
    KINInit(memory_, residual, x_);
    KINSetUserData(memory_, data);
    KINSetLinearSolver(memory_, linear_, J_);
    KINSetJacFn(memory_, jacobian);
    KINSetMaxSetupCalls(memory_, 1);
    KINSetFuncNormTol(memory_, kTolerance);
    KINSetScaledStepTol(memory_, 1e-16);
  }
  KinsolSolver(const KinsolSolver&) = delete;
  KinsolSolver& operator=(const KinsolSolver&) = delete;
  ~KinsolSolver() {
    KINFree(&memory_);
    SUNLinSolFree(linear_);
    SUNMatDestroy(J_);
    N_VDestroy(ones_);
    N_VDestroy(x_);
    SUNContext_Free(&context_);
  }

  /// The start, and after `solve` where it ended.
  [[nodiscard]] double* x() { return N_VGetArrayPointer(x_); }
  /// Does it say that it has converged?
  bool solve() { return KINSol(memory_, x_, KIN_LINESEARCH, ones_, ones_) >= 0; }
  [[nodiscard]] int iterations() const {
    long iterations = 0;
    KINGetNumNonlinSolvIters(memory_, &iterations);
    return static_cast<int>(iterations);
  }

 private:
  SUNContext context_ = nullptr;
  N_Vector x_ = nullptr, ones_ = nullptr;
  SUNMatrix J_ = nullptr;
  SUNLinearSolver linear_ = nullptr;
  void* memory_ = nullptr;
};
#endif

#ifdef CONDYLE_HAS_CERES
inline ceres::Solver::Options dogleg_options() {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.trust_region_strategy_type = ceres::DOGLEG;
  options.logging_type = ceres::SILENT;
  options.max_num_iterations = kMostIterations;
  options.function_tolerance = 0;
  options.parameter_tolerance = 1e-15;
  options.gradient_tolerance = 0;
  return options;
}
#endif

}  // namespace condyle::accuracy
