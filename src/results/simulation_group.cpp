#include "results/simulation_group.h"

#include <functional>

namespace condyle {
namespace {

constexpr double kKilogram = 1e-3;      // tonne
constexpr double kJoule = 1e3;          // N mm
constexpr double kDegree = M_PI / 180;  // rad

class SimulationWriter {
 public:
  SimulationWriter(const Hdf5Group& group, const Motion& motion) : group_(group), motion_(motion) {}

  using OfFrame = std::function<double(const MotionFrame&)>;
  void column(const Hdf5Group& group,
              const std::string& name,
              const OfFrame& of,
              const std::string& units) const {
    std::vector<double> values;
    for (const MotionFrame& frame : motion_.frames) values.push_back(of(frame));
    group.write(name, values, {values.size()}, units);
  }

  void write_frames() const {
    column(
        group_, "time", [](const MotionFrame& f) { return f.state.t; }, "s");
    std::vector<double> v, w;
    for (const MotionFrame& frame : motion_.frames)
      for (int k = 0; k < 3; ++k) {
        v.push_back(frame.state.bodies[0].v[k]);
        w.push_back(frame.state.bodies[0].omega[k] / kDegree);
      }
    group_.write("velocity", v, {motion_.frames.size(), 3}, "mm/s");
    group_.write("angular_velocity", w, {motion_.frames.size(), 3}, "deg/s");
  }

  void write_energy() const {
    const Hdf5Group energy = group_.create("energy");
    const auto joules = [&](const std::string& name, const OfFrame& of) {
      column(
          energy, name, [&](const MotionFrame& f) { return of(f) / kJoule; }, "J");
    };
    joules("kinetic", [](const MotionFrame& f) { return f.energy.kinetic; });
    joules("gravity", [](const MotionFrame& f) { return f.energy.gravity; });
    joules("ligaments", [](const MotionFrame& f) { return f.energy.elastic; });
    joules("dissipated", [](const MotionFrame& f) { return f.dissipated; });
    joules("driver_work", [](const MotionFrame& f) { return f.driver_work; });
    joules("balance", [](const MotionFrame& f) { return f.balance(); });
  }

  void write_events(const std::vector<int>& contact_of) const {
    const Hdf5Group events = group_.create("events");
    std::vector<double> time, speed;
    std::vector<int> contact, closing;
    for (const ContactEvent& event : motion_.events) {
      time.push_back(event.t);
      speed.push_back(event.speed);
      contact.push_back(contact_of[event.contact]);
      closing.push_back(event.closing ? 1 : 0);
    }
    const Shape shape = {time.size()};
    events.write("time", time, shape, "s");
    events.write("contact", contact, shape, "1");
    events.write("closing", closing, shape, "1");
    events.write("speed", speed, shape, "mm/s");
  }

 private:
  const Hdf5Group& group_;
  const Motion& motion_;
};

}  // namespace

void write_simulation(const Hdf5Group& group, const Scene& scene, const Simulation& simulation) {
  const Motion& motion = simulation.motion;
  group.write_attribute("completed", motion.completed ? "yes" : "no");
  group.write_attribute("reason", motion.reason);
  group.write_attribute("velocity_of", "mass centre of " + scene.bodies[scene.moving_body()].name);
  group.write("mass", std::vector<double>{simulation.mass.mass / kKilogram}, {1}, "kg");
  const Eigen::Vector3d& center = simulation.mass.center;
  group.write("mass_center", std::vector<double>(center.data(), center.data() + 3), {3}, "mm");
  const SimulationWriter writer(group, motion);
  writer.write_frames();
  writer.write_energy();
  writer.write_events(simulation.contact_of);
}

}  // namespace condyle
