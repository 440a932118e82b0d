#include <algorithm>

#include "condyle/scene_file/read_sections.h"

namespace condyle {
namespace {

using Shape = DriveDescription::Shape;

void read_table(const Section& section, DriveDescription& drive) {
  drive.times = section.numbers("times", "times [t1, t2, ...]");
  drive.factors = section.numbers("factors", "factors [s1, s2, ...]");
  if (drive.times.size() < 2 || drive.factors.size() != drive.times.size())
    section.fail("factors", "two or more factors, as many as times");
  if (!std::is_sorted(drive.times.begin(), drive.times.end(), std::less_equal<>()))
    section.fail("times", "times that increase");
}

DriveDescription read_drive(const Section& section, const Scene& scene) {
  static const Choices<Shape> shapes = {
      {"pulse", Shape::kPulse}, {"decaying sine", Shape::kDecayingSine}, {"table", Shape::kTable}};
  DriveDescription drive;
  drive.load = section.reference("load", "the name of a load", names_of(scene.loads));
  drive.shape = section.choice("shape", shapes);
  if (drive.shape == Shape::kTable) {
    read_table(section, drive);
  } else {
    drive.start = section.number_or("start", 0, "a time in s", Range::kNotNegative);
    if (drive.shape == Shape::kPulse) {
      drive.duration = section.number("duration", "a time in s", Range::kPositive);
    } else {
      drive.frequency = section.number("frequency", "oscillations per second", Range::kPositive);
      drive.decay = section.number("decay", "a rate in 1/s", Range::kNotNegative);
    }
  }
  section.finish();
  return drive;
}

DamperDescription read_damper(const Section& section,
                              const Scene& scene,
                              const std::vector<std::string>& taken) {
  DamperDescription damper;
  damper.name = read_name(section, taken);
  damper.ends = read_ends(section, scene);
  damper.coefficient =
      section.number("coefficient", "N s per length unit", Range::kPositive) / scene.length_to_mm;
  section.finish();
  return damper;
}

void read_held(const Section& section, const Scene& scene, SimulationDescription& simulation) {
  const std::string expected = "names of conditions [\"internal rotation\", ...]";
  const Value& held = section.value("hold", expected);
  if (held.type != Value::Type::kArray) section.fail("hold", expected);
  for (const Value& name : held.items) {
    const int index =
        section.reference("hold", name, "the name of a condition", names_of(scene.conditions));
    if (std::find(simulation.hold.begin(), simulation.hold.end(), index) != simulation.hold.end())
      section.fail("hold", name, "each condition once");
    simulation.hold.push_back(index);
  }
}

void read_start(const Section& section, const Scene& scene, SimulationDescription& simulation) {
  if (section.has("flexion")) {
    if (!scene.joint) section.fail("flexion", "a table [joint] that says what flexion is");
    simulation.flexion = read_angle(section, "flexion", scene);
  }
  if (section.has("flexion_velocity")) {
    if (!simulation.flexion) section.fail("flexion_velocity", "flexion beside it");
    simulation.flexion_velocity =
        scene.angle_to_rad * section.number("flexion_velocity", "an angle per second");
  }
}

}  // namespace

void read_simulation(const Section& root, Scene& scene) {
  if (!root.has("simulate")) return;
  const Section section = root.table("simulate", "a table [simulate] with time, rate and gravity");
  SimulationDescription simulation;
  simulation.time = section.number("time", "a time in s", Range::kPositive);
  simulation.rate = section.number_or("rate", 100, "frames per second", Range::kPositive);
  constexpr double kMostFrames = 1e6;
  if (simulation.time * simulation.rate > kMostFrames)
    section.fail("rate", "at most a million frames");
  constexpr double kMostPerSecond = 1e9;  // a driver's jump is passed in steps of 1e-12 s
  if (simulation.rate > kMostPerSecond) section.fail("rate", "at most 1e9 frames per second");
  if (section.has("gravity"))
    simulation.gravity = scene.length_to_mm * section.vector("gravity", "an acceleration");
  read_start(section, scene, simulation);
  simulation.restitution = section.number_or("restitution", 0, "a number from 0 to 1");
  if (simulation.restitution < 0 || simulation.restitution > 1)
    section.fail("restitution", "a number from 0 to 1");
  constexpr double kCoarsest = 1e-3, kFinest = 1e-13;  // rounding leaves the integrator no less
  simulation.tolerance = section.number_or("tolerance", 1e-9, "a tolerance", Range::kPositive);
  if (simulation.tolerance > kCoarsest || simulation.tolerance < kFinest)
    section.fail("tolerance", "a tolerance from 1e-13 to 1e-3");
  simulation.viscous_time =
      section.number_or("viscous_time", 0, "a time in s", Range::kNotNegative);
  if (section.has("hold")) read_held(section, scene, simulation);
  const auto is_flexion = [&](int i) {
    return scene.conditions[static_cast<std::size_t>(i)].kind == ConditionKind::kFlexion;
  };
  if (simulation.flexion_velocity != 0 &&
      std::any_of(simulation.hold.begin(), simulation.hold.end(), is_flexion))
    section.fail("flexion_velocity", "none, or a flexion that hold does not keep");
  if (section.has("drive"))
    for (const Section& drive : section.tables("drive", "drives [{ load = \"...\", shape = ... }]"))
      simulation.drives.push_back(read_drive(drive, scene));
  if (section.has("damper"))
    for (const Section& damper : section.tables("damper", "dampers [{ name, ends, coefficient }]"))
      simulation.dampers.push_back(read_damper(damper, scene, names_of(simulation.dampers)));
  section.finish();
  scene.simulation = simulation;
}

}  // namespace condyle
