#include "condyle/network/moving_network.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/input_error.h"
#include "condyle/network/contact_changes.h"
#include "condyle/network/motion_lattices.h"
#include "condyle/network/project.h"
#include "condyle/network/record_motion.h"

namespace condyle {
namespace {

/// An open contact strikes where it approaches and is this deep, of L: less is round-off.
constexpr double kStrike = 1e-10 / 30;
constexpr double kSpeedAsLength = 0.1;  // [s], of speeds that are compared with lengths

bool is_constrained(const Network& network) {
  if (!network.contacts.empty() || !network.joints.empty() || !network.conditions.empty())
    return true;
  return std::any_of(network.motions.begin(), network.motions.end(),
                     [&](const MotionDriver& m) { return network.ports[m.port].body >= 0; });
}

std::vector<int> contacts_that_open(const Network& network) {
  std::vector<int> watched;
  for (std::size_t i = 0; i < network.contacts.size(); ++i)
    if (network.contacts[i].opens) watched.push_back(static_cast<int>(i));
  return watched;
}

std::vector<double> scaled(std::vector<double> scales, double tolerance) {
  for (double& scale : scales) scale *= tolerance;
  return scales;
}

}  // namespace

MovingNetwork::MovingNetwork(const Network& network,
                             NetworkState start,
                             const IntegrationOptions& options)
    : network_(network),
      options_(options),
      equations_(network),
      state_(std::move(start)),
      numbers_(network),
      watched_(contacts_that_open(network)),
      remainder_(network.length / 3000 * options.tolerance),  // a thousandth of that of a length
      ode_(system(),
           state_.t,
           std::vector<double>(numbers_.size()),
           options.tolerance,
           scaled(numbers_.scales(), options.tolerance),
           options.most_steps) {
  equations_.require_mass();
}

OdeSystem MovingNetwork::system() {
  OdeSystem system;
  system.rate = [this](double t, const double* y, double* rate) {
    if (!evaluate(t, y)) return false;
    numbers_.rates(y, equations_, rate);
    return true;
  };
  if (is_constrained(network_))
    system.project = [this](double t, const double* y, double* correction, double* error) {
      return project(t, y, correction, error);
    };
  system.events = [this](double t, const double* y, double* values) {
    return find_events(t, y, values);
  };
  system.event_count = static_cast<int>(watched_.size());
  return system;
}

void MovingNetwork::check_start() {
  if (!equations_.assemble(state_))
    throw InputError("network: a contact or a line has no direction at the start");
  constexpr double kAllowed = 1e-6, kAllowedSpeed = 1e-3;
  const Eigen::VectorXd change = equations_.velocity_correction();
  for (const ConstraintRow& row : equations_.rows()) {
    if (std::abs(row.value) > kAllowed)
      throw InputError(
          fmt::format("network: \"{}\" is {} off at the start, expected a start that "
                      "satisfies its constraints",
                      equations_.graph().graph.edges[row.edge].name, row.value));
  }
  if (change.size() > 0 && change.cwiseAbs().maxCoeff() > kAllowedSpeed)
    throw InputError("network: the velocities at the start violate the constraints");
  if (!condyle::project(equations_, state_))
    throw InputError("network: the start cannot be put onto its constraints");
}

MovingNetwork::Moment MovingNetwork::moment(double t) {
  return {t, std::vector<double>(ode_.y(), ode_.y() + numbers_.size()), state_, equations_.paths()};
}

void MovingNetwork::go_back(const Moment& moment) {
  std::copy(moment.numbers.begin(), moment.numbers.end(), ode_.y());
  state_ = moment.state;
  equations_.begin_anew(moment.paths);
  evaluated_ = NAN;
  ode_.restart(moment.t);
}

std::vector<int> MovingNetwork::found() const {
  std::vector<int> contacts;
  for (const int k : ode_.found()) contacts.push_back(watched_[k]);
  return contacts;
}

bool MovingNetwork::land(double t) {
  state_.t = t;
  numbers_.unpack(ode_.y(), state_);
  dissipated_ = numbers_.dissipated(ode_.y());
  work_ = numbers_.work(ode_.y());
  evaluated_ = NAN;
  return condyle::project(equations_, state_);
}

bool MovingNetwork::change_contacts(const std::vector<int>& struck,
                                    const std::vector<int>& released,
                                    std::vector<ContactEvent>& events) {
  const std::optional<double> lost =
      condyle::change_contacts(equations_, state_, struck, released, options_, events);
  dissipated_ += lost.value_or(0);
  return lost.has_value();
}

void MovingNetwork::restart(double t) {
  numbers_.pack(state_, dissipated_, work_, ode_.y());
  evaluated_ = NAN;
  ode_.restart(t);
}

void MovingNetwork::begin_anew(const MotionFrame& frame) {
  state_ = frame.state;
  dissipated_ = frame.dissipated;
  work_ = frame.driver_work;
  equations_.begin_anew(frame.paths);
  forget_places(network_);
  restart(state_.t);
}

bool MovingNetwork::record(Motion& motion) {
  if (!equations_.assemble(state_) || !equations_.solve()) return false;
  record_frame(equations_, state_, dissipated_, work_, motion);
  return true;
}

bool MovingNetwork::evaluate(double t, const double* y) {
  evaluated_ = NAN;
  state_.t = t;
  numbers_.unpack(y, state_);
  if (!equations_.assemble(state_, false) || !equations_.solve()) return false;
  evaluated_ = t;
  return true;
}

bool MovingNetwork::project(double t, const double* y, double* correction, double* error) {
  state_.t = t;
  numbers_.unpack(y, state_);
  if (evaluated_ != t || !project_nearby(equations_, remainder_, state_)) {
    evaluated_ = NAN;
    if (!condyle::project(equations_, state_)) return false;
  }
  numbers_.difference(state_, y, correction);
  if (error != nullptr) numbers_.keep_admissible(y, equations_, error);
  return true;
}

bool MovingNetwork::find_events(double t, const double* y, double* values) {
  state_.t = t;
  numbers_.unpack(y, state_);
  if (evaluated_ == t && is_nearby(equations_, remainder_, state_) && set_event_values(values) &&
      event_is_far(values))
    return true;
  return evaluate(t, y) && set_event_values(values);
}

/// Forces that are not those of exactly this state cannot be mistaken.
bool MovingNetwork::event_is_far(const double* values) const {
  constexpr double kSure = 1;  // [N]
  for (std::size_t k = 0; k < watched_.size(); ++k)
    if (state_.contacts[watched_[k]].closed && !(values[k] > kSure)) return false;
  return true;
}

/// The force of a closed contact; of an open one what is below zero where it is deep and
/// approaches. Depth alone is no strike: a gap that opens with neither speed nor acceleration is
/// for some microseconds less than the integrator's error of a position.
bool MovingNetwork::set_event_values(double* values) {
  for (std::size_t k = 0; k < watched_.size(); ++k) {
    const auto contact = static_cast<std::size_t>(watched_[k]);
    const MovingContact& own = state_.contacts[contact];
    if (own.closed) {
      values[k] = equations_.contact_force(contact);
      continue;
    }
    if (own.followed && !equations_.settle(contact, state_)) return false;
    values[k] = own.followed
                    ? std::max(equations_.contact(contact).gap() + kStrike * network_.length,
                               kSpeedAsLength * equations_.settled_gap_rate(contact, state_))
                    : 1;
  }
  return true;
}

std::optional<std::string> MovingNetwork::lost_contact() {
  constexpr double kAlike = 0.1;  // of the other direction's relative curvature
  evaluated_ = NAN;
  numbers_.unpack(ode_.y(), state_);
  if (const auto& lost = equations_.lost_line(); lost.line >= 0 && lost.t >= state_.t) {
    const LineComponent& line = network_.lines[static_cast<std::size_t>(lost.line)];
    return fmt::format("line \"{}\" has no {}", line.name, line.path ? "shortest path" : "length");
  }
  if (!equations_.assemble(state_)) return std::nullopt;
  for (std::size_t i = 0; i < network_.contacts.size(); ++i) {
    if (!state_.contacts[i].closed) continue;
    const auto [least, greatest] = equations_.contact(i).relative_curvature;
    if (least < kAlike * greatest)
      return fmt::format(
          "contact \"{}\" ceases to be an isolated point (relative curvature {:.2g} 1/mm)",
          network_.contacts[i].name, least);
  }
  return std::nullopt;
}

}  // namespace condyle
