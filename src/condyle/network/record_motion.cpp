#include "condyle/network/record_motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace condyle {
namespace {

void add_contacts(const NetworkEquations& equations, MotionFrame& frame) {
  const Eigen::Vector3d nowhere = Eigen::Vector3d::Constant(NAN);
  for (std::size_t i = 0; i < frame.state.contacts.size(); ++i) {
    const ContactLinearization& contact = equations.contact(i);
    const bool known = frame.state.contacts[i].followed;
    frame.contact_force.push_back(equations.contact_force(i));
    frame.contact_gap.push_back(known ? contact.gap() : INFINITY);
    frame.contact_point.push_back(known ? contact.B.c : nowhere);
  }
}

bool has_sizes_of(const MotionFrame& frame, const MotionFrame& first) {
  const std::size_t contacts = first.state.contacts.size();
  return frame.state.bodies.size() == first.state.bodies.size() &&
         frame.state.contacts.size() == contacts && frame.contact_force.size() == contacts &&
         frame.contact_gap.size() == contacts && frame.contact_point.size() == contacts &&
         frame.lines.size() == first.lines.size() && frame.paths.size() == first.paths.size() &&
         frame.condition_multiplier.size() == first.condition_multiplier.size();
}

bool is_finite(const BodyState& body) {
  return body.X.R.allFinite() && body.X.p.allFinite() && body.v.allFinite() &&
         body.omega.allFinite();
}

bool has_places(const MovingContact& contact) {
  return !(contact.followed || contact.closed) ||
         (contact.places.on_B.numbers.allFinite() && contact.places.on_A.numbers.allFinite());
}

void audit(const MotionFrame& frame, Motion& motion) {
  const MotionFrame& first = motion.frames.empty() ? frame : motion.frames.front();
  motion.largest_imbalance =
      std::max(motion.largest_imbalance, std::abs(frame.balance() - first.balance()));
  motion.energy_scale =
      std::max({motion.energy_scale, frame.energy.kinetic, std::abs(frame.energy.elastic),
                frame.energy.layers, std::abs(frame.energy.gravity - first.energy.gravity),
                std::abs(frame.driver_work)});
}

}  // namespace

void record_frame(const NetworkEquations& equations,
                  const NetworkState& state,
                  double dissipated,
                  double driver_work,
                  Motion& motion) {
  MotionFrame frame;
  frame.state = state;
  add_contacts(equations, frame);
  frame.lines = equations.lines();
  frame.paths = equations.paths();
  for (std::size_t k = 0; k < equations.rows().size(); ++k)
    if (equations.rows()[k].condition >= 0)
      frame.condition_multiplier.push_back(equations.multipliers()[static_cast<Eigen::Index>(k)]);
  frame.energy = equations.energies();
  frame.dissipated = dissipated;
  frame.driver_work = driver_work;
  add_frame(std::move(frame), motion);
}

void add_frame(MotionFrame frame, Motion& motion) {
  audit(frame, motion);
  motion.frames.push_back(std::move(frame));
}

bool is_of_motion(const MotionFrame& frame, const MotionFrame& first) {
  return has_sizes_of(frame, first) && std::isfinite(frame.dissipated) &&
         std::isfinite(frame.driver_work) &&
         std::all_of(frame.state.bodies.begin(), frame.state.bodies.end(), is_finite) &&
         std::all_of(frame.state.contacts.begin(), frame.state.contacts.end(), has_places);
}

}  // namespace condyle
