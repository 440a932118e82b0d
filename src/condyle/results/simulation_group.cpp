#include "condyle/results/simulation_group.h"

#include <functional>

#include "condyle/math/degree.h"

namespace condyle {
namespace {

constexpr double kKilogram = 1e-3;  // tonne
constexpr double kJoule = 1e3;      // N mm

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
    joules("layers", [](const MotionFrame& f) { return f.energy.layers; });
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

namespace {

void read_energy(const Hdf5Group& energy, std::vector<MotionFrame>& frames) {
  const auto joules = [&](const char* name, const std::function<void(MotionFrame&, double)>& set) {
    const std::vector<double> values = energy.read(name, {frames.size()});
    for (std::size_t i = 0; i < frames.size(); ++i) set(frames[i], kJoule * values[i]);
  };
  joules("kinetic", [](MotionFrame& f, double e) { f.energy.kinetic = e; });
  joules("gravity", [](MotionFrame& f, double e) { f.energy.gravity = e; });
  joules("ligaments", [](MotionFrame& f, double e) { f.energy.elastic = e; });
  if (energy.has("layers")) joules("layers", [](MotionFrame& f, double e) { f.energy.layers = e; });
  joules("dissipated", [](MotionFrame& f, double e) { f.dissipated = e; });
  joules("driver_work", [](MotionFrame& f, double e) { f.driver_work = e; });
}

void read_frames(const Hdf5Group& group, std::vector<MotionFrame>& frames) {
  const std::vector<double> time = group.read("time").values;
  frames.resize(time.size());
  const std::vector<double> v = group.read("velocity", {time.size(), 3}),
                            w = group.read("angular_velocity", {time.size(), 3});
  for (std::size_t i = 0; i < time.size(); ++i) {
    NetworkState& state = frames[i].state;
    state.t = time[i];
    state.bodies.resize(1);
    for (std::size_t k = 0; k < 3; ++k) {
      state.bodies[0].v[static_cast<Eigen::Index>(k)] = v[3 * i + k];
      state.bodies[0].omega[static_cast<Eigen::Index>(k)] = kDegree * w[3 * i + k];
    }
  }
}

/// Contacts of the events are those of the scene.
void read_motion_events(const Hdf5Group& events, const Scene& scene, Motion& motion) {
  const std::vector<double> time = events.read("time").values;
  const Shape shape = {time.size()};
  const std::vector<double> speed = events.read("speed", shape);
  const std::vector<int> contact = events.read_integers("contact", shape),
                         closing = events.read_integers("closing", shape);
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (contact[i] < 0 || contact[i] >= static_cast<int>(scene.contacts.size()))
      events.fail("holds an event of no known contact");
    motion.events.push_back({time[i], contact[i], closing[i] == 1, speed[i]});
  }
}

}  // namespace

Simulation read_simulation(const Hdf5Group& group, const Scene& scene) {
  Simulation simulation;
  Motion& motion = simulation.motion;
  motion.completed = group.read_attribute("completed") == "yes";
  motion.reason = group.read_attribute("reason");
  simulation.mass.mass = kKilogram * group.read("mass", {1})[0];
  const std::vector<double> center = group.read("mass_center", {3});
  simulation.mass.center = Eigen::Map<const Eigen::Vector3d>(center.data());
  read_frames(group, motion.frames);
  read_energy(group.open("energy"), motion.frames);
  read_motion_events(group.open("events"), scene, motion);
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    simulation.contact_of.push_back(static_cast<int>(i));
  return simulation;
}

}  // namespace condyle
