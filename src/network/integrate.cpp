#include "network/integrate.h"

#include <cvode/cvode.h>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "input_error.h"
#include "network/contact_changes.h"

namespace condyle {
namespace {

constexpr int kPerBody = 13;  // reference port, quaternion, twist
constexpr int kSums = 2;      // dissipated, work of the drivers
constexpr int kRecoverable = 1;
constexpr double kBeforeJump = 1e-12;  // [s]: a step may not see a driver after its jump

/// Owns an object of SUNDIALS.
template <typename T, typename Free>
class Owned {
 public:
  Owned(T object, Free release) : object_(object), free_(release) {}
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  ~Owned() { free_(object_); }
  operator T() const { return object_; }  // NOLINT: handed on to C functions

 private:
  T object_;
  Free free_;
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

bool is_constrained(const Network& network) {
  if (!network.contacts.empty() || !network.joints.empty() || !network.conditions.empty())
    return true;
  return std::any_of(network.motions.begin(), network.motions.end(),
                     [&](const MotionDriver& m) { return network.ports[m.port].body >= 0; });
}

/// One run of CVODE over the state's numbers.
class Integrator {
 public:
  Integrator(const Network& network,
             NetworkState start,
             const IntegrationOptions& options,
             ContactScout scout)
      : network_(network),
        scout_(std::move(scout)),
        options_(options),
        equations_(network),
        state_(std::move(start)),
        size_(static_cast<int>(kPerBody * network.bodies.size()) + kSums),
        constrained_(is_constrained(network)),
        context_(make_context(), free_context),
        y_(N_VNew_Serial(size_, context_), N_VDestroy),
        tolerances_(N_VNew_Serial(size_, context_), N_VDestroy),
        solver_(SUNNonlinSol_FixedPoint(y_, 0, context_), free_solver),
        memory_(CVodeCreate(constrained_ ? CV_BDF : CV_ADAMS, context_), free_memory) {}

  Motion run() {
    equations_.require_mass();
    check_start();
    dissipated_ += change_contacts(equations_, state_, {}, {}, options_, motion_.events);
    if (scout_) scout_(state_);
    pack(state_, dissipated_, 0);
    set_up();
    store(state_.t);
    double t = state_.t;
    const auto frames = static_cast<long>(std::ceil(options_.end / options_.interval - 1e-9));
    motion_.completed = true;
    for (long k = 1; k <= frames && motion_.completed; ++k) {
      const double to = start_ + std::min(options_.end, static_cast<double>(k) * options_.interval);
      if (scout_ ? advance_scouted(t, to, 0) : advance(t, to)) store(t);
      if (options_.on_frame) options_.on_frame(static_cast<int>(k), static_cast<int>(frames));
    }
    add_counts();
    return std::move(motion_);
  }

 private:
  static Integrator& self(void* data) { return *static_cast<Integrator*>(data); }
  double* numbers() { return NV_DATA_S(static_cast<N_Vector>(y_)); }

  void check_start() {
    start_ = state_.t;
    if (!equations_.assemble(state_))
      throw InputError("network: a contact or a line has no direction at the start");
    constexpr double kAllowed = 1e-6;
    const Eigen::VectorXd change = equations_.velocity_correction();
    for (const ConstraintRow& row : equations_.rows()) {
      if (std::abs(row.value) > kAllowed)
        throw InputError(
            fmt::format("network: \"{}\" is {} off at the start, expected a start that "
                        "satisfies its constraints",
                        equations_.graph().graph.edges[row.edge].name, row.value));
    }
    if (change.size() > 0 && change.cwiseAbs().maxCoeff() > 1e-3)
      throw InputError("network: the velocities at the start violate the constraints");
    if (!project(equations_, state_))
      throw InputError("network: the start cannot be put onto its constraints");
  }

  void set_up() {
    double* tolerance = NV_DATA_S(static_cast<N_Vector>(tolerances_));
    // What counts as one on a knee: mm, rad, mm/s, rad/s, N mm.
    constexpr double kScale[kPerBody] = {10, 10, 10, 1, 1, 1, 1, 100, 100, 100, 1, 1, 1};
    for (int i = 0; i < size_ - kSums; ++i)
      tolerance[i] = options_.tolerance * kScale[i % kPerBody];
    for (int i = size_ - kSums; i < size_; ++i) tolerance[i] = options_.tolerance * 100;
    CVodeSetErrHandlerFn(memory_, say_nothing, nullptr);
    CVodeInit(memory_, rate, state_.t, y_);
    CVodeSVtolerances(memory_, options_.tolerance, tolerances_);
    CVodeSetUserData(memory_, this);
    CVodeSetNonlinearSolver(memory_, solver_);
    CVodeSetMaxNumSteps(memory_, options_.most_steps);
    if (constrained_) {
      CVodeSetProjFn(memory_, projection);
      CVodeSetProjErrEst(memory_, SUNFALSE);
    }
    for (std::size_t i = 0; i < network_.contacts.size(); ++i)
      if (network_.contacts[i].opens) watched_.push_back(static_cast<int>(i));
    if (watched_.empty()) return;
    CVodeRootInit(memory_, static_cast<int>(watched_.size()), roots);
    std::vector<int> falling(watched_.size(), -1);
    CVodeSetRootDirection(memory_, falling.data());
    CVodeSetNoInactiveRootWarn(memory_);
  }

  /// What is needed to take a stretch of time back.
  struct Moment {
    double t;
    std::vector<double> numbers;
    NetworkState state;
    std::size_t events;
  };
  Moment moment(double t) {
    return {t, {numbers(), numbers() + size_}, state_, motion_.events.size()};
  }
  void go_back(const Moment& moment) {
    add_counts();
    std::copy(moment.numbers.begin(), moment.numbers.end(), numbers());
    state_ = moment.state;
    motion_.events.resize(moment.events);
    motion_.completed = true;
    motion_.reason.clear();
    CVodeReInit(memory_, moment.t, y_);
  }

  /// Goes on in halves where the way led into an overlap that no contact saw, or where a contact
  /// was lost.
  bool advance_scouted(double& t, double to, int halvings) {
    constexpr int kMostHalvings = 12;
    constexpr double kTouch = 1e-5;  // [mm]: a contact that opened for nothing
    const Moment before = moment(t);
    if (advance(t, to)) {
      unpack(numbers(), t);
      if (!project(equations_, state_)) return give_up(t, "the constraints could not be met");
      const ContactSighting sighting = scout_(state_);
      if (sighting.unseen >= 0 && sighting.overlapping.empty()) return true;
      if (sighting.unseen >= 0 && sighting.followed > -kTouch)
        return handle_event(t, sighting.overlapping, {});
      give_up(
          t,
          "the bodies overlap where no contact could be followed, as beyond the edge of a surface");
    }
    if (halvings == kMostHalvings) return false;
    go_back(before);
    t = before.t;
    const double middle = t + (to - t) / 2;
    return advance_scouted(t, middle, halvings + 1) && advance_scouted(t, to, halvings + 1);
  }

  bool advance(double& t, double to) {
    constexpr int kMostEvents = 1000;
    for (int events = 0; t < to - 2 * kBeforeJump; ++events) {
      const double jump = next_jump(t), stop = std::min(to, jump - kBeforeJump);
      if (stop <= t) {  // just before a jump: go on behind it
        t = jump;
        if (!handle_event(t, {}, {})) return false;
        continue;
      }
      CVodeSetStopTime(memory_, stop);
      const int flag = CVode(memory_, stop, y_, &t, CV_NORMAL);
      if (flag < 0 || events == kMostEvents) {
        return give_up(t, flag < 0 ? lost_contact().value_or(failure(flag))
                                   : std::string("contacts open and close without end"));
      }
      if (flag == CV_ROOT_RETURN && !handle_root(t)) return false;
    }
    return true;
  }

  /// The next time after t at which a driver jumps, or never.
  double next_jump(double t) const {
    double next = INFINITY;
    for (const double jump : options_.breaks)
      if (jump > t) next = std::min(next, jump);
    return next;
  }

  /// A closed contact whose surfaces have come to bend alike in one direction: its point runs away,
  /// and the contact will be somewhere else.
  std::optional<std::string> lost_contact() {
    constexpr double kAlike = 0.1;  // of the other direction's relative curvature
    unpack(numbers(), state_.t);
    if (!equations_.assemble(state_)) return std::nullopt;
    for (std::size_t i = 0; i < network_.contacts.size(); ++i) {
      const auto [least, greatest] = equations_.contacts()[i].relative_curvature;
      if (state_.contacts[i].closed && least < kAlike * greatest)
        return fmt::format(
            "contact \"{}\" ceases to be an isolated point (relative curvature {:.2g} 1/mm)",
            network_.contacts[i].name, least);
    }
    return std::nullopt;
  }

  static std::string failure(int flag) {
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

  bool give_up(double t, const std::string& reason) {
    motion_.completed = false;
    motion_.reason = fmt::format("at {:.6g} s: {}", t, reason);
    return false;
  }

  bool handle_root(double t) {
    std::vector<int> found(watched_.size()), struck, released;
    CVodeGetRootInfo(memory_, found.data());
    for (std::size_t k = 0; k < found.size(); ++k) {
      if (found[k] == 0) continue;
      (state_.contacts[watched_[k]].closed ? released : struck).push_back(watched_[k]);
    }
    return handle_event(t, struck, released);
  }

  /// Contacts change where a root was found, or may where a driver jumps.
  bool handle_event(double t, const std::vector<int>& struck, const std::vector<int>& released) {
    unpack(numbers(), t);
    if (!project(equations_, state_)) return give_up(t, "the constraints could not be met");
    const double lost =
        change_contacts(equations_, state_, struck, released, options_, motion_.events);
    const double* y = numbers();
    pack(state_, y[size_ - 2] + lost, y[size_ - 1]);
    add_counts();
    CVodeReInit(memory_, t, y_);
    return true;
  }

  void add_counts() {
    long steps = 0, evaluations = 0;
    CVodeGetNumSteps(memory_, &steps);
    CVodeGetNumRhsEvals(memory_, &evaluations);
    motion_.steps += steps;
    motion_.evaluations += evaluations;
  }

  void pack(const NetworkState& state, double dissipated, double work) {
    double* y = numbers();
    for (std::size_t b = 0; b < state.bodies.size(); ++b, y += kPerBody) {
      const BodyState& body = state.bodies[b];
      Eigen::Map<Eigen::Vector3d>{y} = body.X * network_.bodies[b].reference;
      const Eigen::Quaterniond q(body.X.R);
      y[3] = q.w();
      Eigen::Map<Eigen::Vector3d>(y + 4) = q.vec();
      Eigen::Map<Eigen::Vector3d>(y + 7) = body.v;
      Eigen::Map<Eigen::Vector3d>(y + 10) = body.omega;
    }
    y[0] = dissipated;
    y[1] = work;
  }

  void unpack(const double* y, double t) {
    state_.t = t;
    for (std::size_t b = 0; b < state_.bodies.size(); ++b, y += kPerBody) {
      BodyState& body = state_.bodies[b];
      body.X.R = Eigen::Quaterniond(y[3], y[4], y[5], y[6]).normalized().toRotationMatrix();
      body.X.p = Eigen::Map<const Eigen::Vector3d>(y) - body.X.R * network_.bodies[b].reference;
      body.v = Eigen::Map<const Eigen::Vector3d>(y + 7);
      body.omega = Eigen::Map<const Eigen::Vector3d>(y + 10);
    }
  }

  bool evaluate(const double* y, double t) {
    unpack(y, t);
    return equations_.assemble(state_) && equations_.solve();
  }

  static int rate(realtype t, N_Vector y, N_Vector ydot, void* data) {
    Integrator& my = self(data);
    const double* in = NV_DATA_S(y);
    if (!my.evaluate(in, t)) return kRecoverable;
    double* out = NV_DATA_S(ydot);
    for (std::size_t b = 0; b < my.state_.bodies.size(); ++b, in += kPerBody, out += kPerBody) {
      const BodyState& body = my.state_.bodies[b];
      const Eigen::Quaterniond q(in[3], in[4], in[5], in[6]);
      const Eigen::Quaterniond turn =
          Eigen::Quaterniond(0, body.omega[0], body.omega[1], body.omega[2]) * q;
      Eigen::Map<Eigen::Vector3d>{out} = body.v;
      out[3] = turn.w() / 2;
      Eigen::Map<Eigen::Vector3d>(out + 4) = turn.vec() / 2;
      Eigen::Map<Vector6>(out + 7) =
          my.equations_.accelerations().segment<6>(static_cast<Eigen::Index>(6 * b));
    }
    out[0] = 0;
    for (const LineState& line : my.equations_.lines()) out[0] += line.dissipation;
    out[1] = my.equations_.driver_power();
    return 0;
  }

  static int roots(realtype t, N_Vector y, realtype* g, void* data) {
    Integrator& my = self(data);
    if (!my.evaluate(NV_DATA_S(y), t)) return kRecoverable;
    for (std::size_t k = 0; k < my.watched_.size(); ++k) {
      const auto contact = static_cast<std::size_t>(my.watched_[k]);
      const ContactPlaces& places = my.state_.contacts[contact];
      if (!places.followed)
        g[k] = 1;
      else
        g[k] = places.closed ? my.equations_.contact_force(contact)
                             : my.equations_.contacts()[contact].gap();
    }
    return 0;
  }

  static int projection(
      realtype t, N_Vector y, N_Vector correction, realtype, N_Vector, void* data) {
    Integrator& my = self(data);
    const double* in = NV_DATA_S(y);
    my.unpack(in, t);
    if (!project(my.equations_, my.state_)) return kRecoverable;
    double* out = NV_DATA_S(correction);
    for (std::size_t b = 0; b < my.state_.bodies.size(); ++b, in += kPerBody, out += kPerBody) {
      const BodyState& body = my.state_.bodies[b];
      Eigen::Quaterniond q(body.X.R);
      const Eigen::Vector4d before(in[3], in[4], in[5], in[6]);
      Eigen::Vector4d after(q.w(), q.x(), q.y(), q.z());
      if (after.dot(before) < 0) after = -after;
      Eigen::Map<Eigen::Vector3d>{out} =
          body.X * my.network_.bodies[b].reference - Eigen::Map<const Eigen::Vector3d>(in);
      Eigen::Map<Eigen::Vector4d>(out + 3) = after - before;
      Eigen::Map<Eigen::Vector3d>(out + 7) = body.v - Eigen::Map<const Eigen::Vector3d>(in + 7);
      Eigen::Map<Eigen::Vector3d>(out + 10) =
          body.omega - Eigen::Map<const Eigen::Vector3d>(in + 10);
    }
    out[0] = out[1] = 0;
    return 0;
  }

  /// The frame at t, put exactly onto the constraints: between steps CVODE interpolates.
  void store(double t) {
    unpack(numbers(), t);
    if (!project(equations_, state_) || !equations_.assemble(state_) || !equations_.solve()) {
      give_up(t, "the constraints could not be met");
      return;
    }
    MotionFrame frame;
    frame.state = state_;
    for (std::size_t i = 0; i < network_.contacts.size(); ++i) {
      const ContactLinearization& contact = equations_.contacts()[i];
      const bool known = state_.contacts[i].followed;
      const Eigen::Vector3d nowhere = Eigen::Vector3d::Constant(NAN);
      frame.contact_force.push_back(equations_.contact_force(i));
      frame.contact_gap.push_back(known ? contact.gap() : INFINITY);
      frame.contact_point.push_back(known ? contact.B.c : nowhere);
      frame.contact_normal.push_back(known ? contact.B.n : nowhere);
    }
    frame.lines = equations_.lines();
    for (std::size_t k = 0; k < equations_.rows().size(); ++k)
      if (equations_.rows()[k].condition >= 0)
        frame.condition_multiplier.push_back(
            equations_.multipliers()[static_cast<Eigen::Index>(k)]);
    frame.energy = equations_.energies();
    frame.dissipated = numbers()[size_ - 2];
    frame.driver_work = numbers()[size_ - 1];
    audit(frame);
    motion_.frames.push_back(std::move(frame));
  }

  void audit(const MotionFrame& frame) {
    const MotionFrame& first = motion_.frames.empty() ? frame : motion_.frames.front();
    motion_.largest_imbalance =
        std::max(motion_.largest_imbalance, std::abs(frame.balance() - first.balance()));
    motion_.energy_scale = std::max(
        {motion_.energy_scale, frame.energy.kinetic, std::abs(frame.energy.elastic),
         std::abs(frame.energy.gravity - first.energy.gravity), std::abs(frame.driver_work)});
  }

  const Network& network_;
  ContactScout scout_;
  IntegrationOptions options_;
  NetworkEquations equations_;
  NetworkState state_;
  int size_;
  bool constrained_;
  double start_ = 0, dissipated_ = 0;
  std::vector<int> watched_;  ///< contacts that open and close
  Motion motion_;
  Owned<SUNContext, void (*)(SUNContext)> context_;
  Owned<N_Vector, void (*)(N_Vector)> y_, tolerances_;
  Owned<SUNNonlinearSolver, void (*)(SUNNonlinearSolver)> solver_;
  Owned<void*, void (*)(void*)> memory_;
};

}  // namespace

Motion integrate(const Network& network,
                 NetworkState start,
                 const IntegrationOptions& options,
                 ContactScout scout) {
  return Integrator(network, std::move(start), options, std::move(scout)).run();
}

}  // namespace condyle
