#include "condyle/network/ode_integrator.h"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "condyle/math/simd.h"

namespace condyle {
namespace {

constexpr int kRecoverable = 1;

/// Owns an object of SUNDIALS.
template <typename T>
class Owned {
 public:
  Owned(T object, void (*release)(T)) : object_(object), release_(release) {}
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() { release_(object_); }
  operator T() const { return object_; }  // NOLINT: handed on to C functions

 private:
  T object_;
  void (*release_)(T);
};

SUNContext make_context() {
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  return context;
}
void free_context(SUNContext context) { SUNContext_Free(&context); }
void free_memory(void* memory) { CVodeFree(&memory); }
void free_solver(SUNNonlinearSolver solver) { SUNNonlinSolFree(solver); }
void say_nothing(int, const char*, const char*, char*, void*) {}

/// A knee's few numbers ask for short loops: the library's calls cost a third of a step.
CONDYLE_FMA_CLONE
void linear_sum(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
  const double *px = NV_DATA_S(x), *py = NV_DATA_S(y);
  double* pz = NV_DATA_S(z);
  const sunindextype n = NV_LENGTH_S(x);
  for (sunindextype i = 0; i < n; ++i) pz[i] = a * px[i] + b * py[i];
}

CONDYLE_FMA_CLONE
realtype weighted_norm(N_Vector x, N_Vector weights) {
  const double *px = NV_DATA_S(x), *w = NV_DATA_S(weights);
  const sunindextype n = NV_LENGTH_S(x);
  double sum[2] = {0, 0};
  for (sunindextype i = 0; i < n; ++i) sum[i % 2] += px[i] * w[i] * px[i] * w[i];
  return std::sqrt((sum[0] + sum[1]) / static_cast<double>(n));
}

N_Vector make_vector(std::size_t size, SUNContext context) {
  N_Vector vector = N_VNew_Serial(static_cast<sunindextype>(size), context);
  vector->ops->nvlinearsum = linear_sum;
  vector->ops->nvwrmsnorm = weighted_norm;
  return vector;
}

int rate(realtype t, N_Vector y, N_Vector ydot, void* system) {
  const OdeSystem& my = *static_cast<const OdeSystem*>(system);
  return my.rate(t, NV_DATA_S(y), NV_DATA_S(ydot)) ? 0 : kRecoverable;
}

int events(realtype t, N_Vector y, realtype* values, void* system) {
  const OdeSystem& my = *static_cast<const OdeSystem*>(system);
  return my.events(t, NV_DATA_S(y), values) ? 0 : kRecoverable;
}

int project(realtype t, N_Vector y, N_Vector correction, realtype, N_Vector error, void* system) {
  const OdeSystem& my = *static_cast<const OdeSystem*>(system);
  double* errors = error == nullptr ? nullptr : NV_DATA_S(error);
  return my.project(t, NV_DATA_S(y), NV_DATA_S(correction), errors) ? 0 : kRecoverable;
}

std::string reason_of(int flag) {
  switch (flag) {
    case CV_TOO_MUCH_WORK:
      return "too many steps for one frame";
    case CV_ERR_FAILURE:
    case CV_CONV_FAILURE:
      return "the step became too small";
    case CV_FIRST_RHSFUNC_ERR:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_UNREC_RHSFUNC_ERR:
    case CV_RTFUNC_FAIL:
      return "a contact left what is known of its surfaces, or a line has no length";
    case CV_PROJFUNC_FAIL:
    case CV_REPTD_PROJFUNC_ERR:
      return "the constraints could not be met";
    default: {
      char* name = CVodeGetReturnFlagName(flag);
      std::string text = fmt::format("the integrator says {}", name);
      std::free(name);
      return text;
    }
  }
}

}  // namespace

struct OdeIntegrator::Memory {
  Memory(OdeSystem functions, std::size_t size)
      : system(std::move(functions)),
        context(make_context(), free_context),
        y(make_vector(size, context), N_VDestroy),
        tolerances(make_vector(size, context), N_VDestroy),
        solver(SUNNonlinSol_FixedPoint(y, 0, context), free_solver),
        cvode(CVodeCreate(system.project ? CV_BDF : CV_ADAMS, context), free_memory) {}

  void add_counts() {
    long more_steps = 0, more_evaluations = 0;
    CVodeGetNumSteps(cvode, &more_steps);
    CVodeGetNumRhsEvals(cvode, &more_evaluations);
    steps += more_steps;
    evaluations += more_evaluations;
  }

  OdeSystem system;
  Owned<SUNContext> context;
  Owned<N_Vector> y, tolerances;
  Owned<SUNNonlinearSolver> solver;
  Owned<void*> cvode;
  int flag = 0;
  long steps = 0, evaluations = 0;  ///< of earlier starts
};

OdeIntegrator::OdeIntegrator(OdeSystem system,
                             double t,
                             std::vector<double> y,
                             double relative,
                             std::vector<double> absolute,
                             long most_steps)
    : m_(std::make_unique<Memory>(std::move(system), y.size())) {
  std::copy(y.begin(), y.end(), NV_DATA_S(static_cast<N_Vector>(m_->y)));
  std::copy(absolute.begin(), absolute.end(), NV_DATA_S(static_cast<N_Vector>(m_->tolerances)));
  void* cvode = m_->cvode;
  CVodeSetErrHandlerFn(cvode, say_nothing, nullptr);
  CVodeInit(cvode, rate, t, m_->y);
  CVodeSVtolerances(cvode, relative, m_->tolerances);
  CVodeSetUserData(cvode, &m_->system);
  CVodeSetNonlinearSolver(cvode, m_->solver);
  CVodeSetMaxNumSteps(cvode, most_steps);
  if (m_->system.project) CVodeSetProjFn(cvode, project);
  if (m_->system.event_count == 0) return;
  CVodeRootInit(cvode, m_->system.event_count, events);
  std::vector<int> falling(static_cast<std::size_t>(m_->system.event_count), -1);
  CVodeSetRootDirection(cvode, falling.data());
  CVodeSetNoInactiveRootWarn(cvode);
}

OdeIntegrator::~OdeIntegrator() = default;

OdeOutcome OdeIntegrator::advance(double& t, double to, double not_beyond) {
  CVodeSetStopTime(m_->cvode, not_beyond);
  m_->flag = CVode(m_->cvode, to, m_->y, &t, CV_NORMAL);
  if (m_->flag < 0) return OdeOutcome::kFailed;
  return m_->flag == CV_ROOT_RETURN ? OdeOutcome::kEvent : OdeOutcome::kReached;
}

std::vector<int> OdeIntegrator::found() const {
  std::vector<int> found(static_cast<std::size_t>(m_->system.event_count)), which;
  CVodeGetRootInfo(m_->cvode, found.data());
  for (std::size_t k = 0; k < found.size(); ++k)
    if (found[k] != 0) which.push_back(static_cast<int>(k));
  return which;
}

std::string OdeIntegrator::reason() const { return reason_of(m_->flag); }

double* OdeIntegrator::y() { return NV_DATA_S(static_cast<N_Vector>(m_->y)); }

void OdeIntegrator::restart(double t) {
  m_->add_counts();
  CVodeReInit(m_->cvode, t, m_->y);
}

long OdeIntegrator::steps() const {
  long more = 0;
  CVodeGetNumSteps(m_->cvode, &more);
  return m_->steps + more;
}

long OdeIntegrator::evaluations() const {
  long more = 0;
  CVodeGetNumRhsEvals(m_->cvode, &more);
  return m_->evaluations + more;
}

}  // namespace condyle
