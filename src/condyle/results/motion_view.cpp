#include "condyle/results/motion_view.h"

#include <algorithm>

#include "condyle/network/simulate.h"

namespace condyle {
namespace {

MotionEnergies energies_of(const MotionFrame& frame) {
  return {frame.state.t,       frame.energy.kinetic, frame.energy.gravity, frame.energy.elastic,
          frame.energy.layers, frame.dissipated,     frame.driver_work,    frame.balance()};
}

}  // namespace

std::optional<MotionView> motion_view(const Run& run) {
  const Simulation* simulation = run.simulation();
  if (simulation == nullptr) return std::nullopt;
  const Motion& motion = simulation->motion;
  MotionView view;
  view.completed = motion.completed;
  view.reason = motion.reason;
  for (const MotionFrame& frame : motion.frames) {
    view.energies.push_back(energies_of(frame));
    view.layered |= frame.energy.layers > 0;
  }
  for (const ContactEvent& event : motion.events) {
    const int contact = simulation->contact_of.at(static_cast<std::size_t>(event.contact));
    view.events.push_back({event.t, run.scene.contacts.at(static_cast<std::size_t>(contact)).name,
                           event.closing, event.speed});
  }
  if (motion.steps > 0)
    view.computed = {motion.steps, simulation->seconds,
                     motion.largest_imbalance / std::max(motion.energy_scale, 1e-300)};
  return view;
}

}  // namespace condyle
