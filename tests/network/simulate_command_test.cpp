#include "app/run_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/results/hdf5_file.h"
#include "condyle/results/run_view.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle::test {
namespace {

const std::string kMass =
    "mass = 4\ncenter = [0, -100, 0]\n"
    "inertia = [[20000, 0, 0], [0, 5000, 0], [0, 0, 20000]]\n";

/// The ball on its plateau, the leg below it let go at 10 degrees.
std::string released(const std::string& more = "") {
  std::string text =
      with(kSmallScene, "start.rotation = [0, 0, 0]\n", "start.rotation = [0, 0, 0]\n" + kMass);
  text = text.substr(0, text.find("[sweep]"));
  return text + "[simulate]\ntime = 0.1\nrate = 50\ngravity = [0, -9810, 0]\nflexion = 10\n" + more;
}

class SimulateCommand : public CommandLine {};

TEST_F(SimulateCommand, FollowsAMotionAndWritesIt) {
  write("swing.toml", released());
  const Outcome outcome = run("simulate swing.toml -o swing.h5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("Balance kept to"), std::string::npos) << outcome.out;
  const Hdf5Reader reader(at("swing.h5"));
  const Hdf5Group simulation = reader.root().open("simulate");
  const std::vector<double> time = simulation.read("time", {6});
  EXPECT_NEAR(time.back(), 0.1, 1e-12);
  const std::vector<double> balance = simulation.open("energy").read("balance", {6});
  for (const double b : balance) EXPECT_NEAR(b, balance.front(), 1e-7);
  const condyle::Run run_file = read_run(at("swing.h5"));  // what render and plot read
  ASSERT_EQ(run_file.sweep.poses.size(), 6U);
  EXPECT_NEAR(run_file.sweep.poses.front().joint.flexion, 10 * M_PI / 180, 1e-9);
  EXPECT_NEAR(run_file.sweep.poses.back().value, 0.1, 1e-12);
  // What a file does not tell is null and not the best that there is.
  const Outcome read = run("report swing.h5 -o swing.html --no-pictures --no-viewer --json");
  ASSERT_EQ(read.code, 0) << read.err;
  for (const char* none : {"\"imbalance\": null", "\"steps\": null", "\"completed\": true"})
    EXPECT_NE(read.out.find(none), std::string::npos) << none << read.out;
}

/// A scene of the project, from 20 degrees; returns its angles of flexion.
std::vector<double> flexions_of(const std::filesystem::path& file) {
  std::vector<double> flexions;
  for (const PoseResult& pose : read_run(file).sweep.poses)
    flexions.push_back(pose.joint.flexion * 180 / M_PI);
  return flexions;
}

// Hanging at 55 degrees and let go at 20, the shank swings to about 90 less what it loses, in a
// second and a bit; the compression along it brings the middle down a few degrees.
TEST_F(SimulateCommand, ThePhantomsShankSwings) {
  const Outcome outcome =
      run("simulate '" CONDYLE_SOURCE_DIR "/data/phantom/pendulum.toml' -o swing.h5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<double> flexions = flexions_of(at("swing.h5"));
  ASSERT_EQ(flexions.size(), 201U);
  EXPECT_NEAR(flexions.front(), 20, 1e-6);
  EXPECT_NEAR(*std::max_element(flexions.begin(), flexions.end()), 82, 8);
  const auto back = std::min_element(flexions.begin() + 60, flexions.begin() + 160);
  EXPECT_NEAR(*back, 22, 3);
  EXPECT_NEAR(static_cast<double>(back - flexions.begin()) / 100, 1.2, 0.1);
}

TEST_F(SimulateCommand, ABlowOpensAndClosesTheCompartments) {
  const Outcome outcome =
      run("simulate '" CONDYLE_SOURCE_DIR "/data/phantom/blow.toml' -o blow.h5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Hdf5Reader reader(at("blow.h5"));
  const Hdf5Group simulation = reader.root().open("simulate");
  const std::size_t n = simulation.open("events").read("closing").values.size();
  EXPECT_GE(n, 2U);
  EXPECT_GT(flexions_of(at("blow.h5")).back(), 30);
  const std::vector<double> work = simulation.open("energy").read("driver_work").values;
  EXPECT_GT(work.back(), 0.5);  // [J]
}

// 100 N e^(-10 t) sin(10 π t) pushes the shank back first, then forward: it gains and loses speed.
TEST_F(SimulateCommand, ADecayingSineSwingsTheShankToAndFro) {
  const Outcome outcome =
      run("simulate '" CONDYLE_SOURCE_DIR "/data/phantom/decaying-sine.toml' -o sine.h5");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<double> flexions = flexions_of(at("sine.h5"));
  ASSERT_EQ(flexions.size(), 201U);
  EXPECT_GT(flexions.back(), 45);
  const double before = flexions[60] - flexions[50], after = flexions[105] - flexions[95];
  EXPECT_GT(before,
            1.3 * after);  // 100 to 120 ms, at the end of the push; 190 to 210 ms, of the pull
  const Hdf5Reader reader(at("sine.h5"));
  const Hdf5Group energy = reader.root().open("simulate").open("energy");
  const std::vector<double> work = energy.read("driver_work").values;
  EXPECT_GT(*std::max_element(work.begin(), work.end()), work.back() + 0.05);  // [J]
}

// What leaves the surfaces ends with its reason and angle, and what was computed is kept.
/// A blow on the phantom's shank for 150 ms, followed for twice as long.
std::string hard_blow(int newton) {
  std::string scene = contents(CONDYLE_SOURCE_DIR "/data/phantom/blow.toml");
  scene = with(scene, "vector = [-50, 0, 0]", fmt::format("vector = [-{}, 0, 0]", newton));
  scene = with(scene, "duration = 0.1", "duration = 0.15");
  scene = with(scene, "time = 0.2", "time = 0.3");
  for (int k = 0; k < 2; ++k)
    scene = with(scene, "\"../../meshes", "\"" CONDYLE_SOURCE_DIR "/meshes");
  return scene;
}

TEST_F(SimulateCommand, AMotionThatLeavesItsSurfacesSaysWhereAndKeepsItsFrames) {
  write("hard.toml", hard_blow(140));
  const Outcome outcome = run("simulate hard.toml -o hard.h5");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("deg of flexion at the frame before"), std::string::npos)
      << outcome.err;
  const std::vector<double> flexions = flexions_of(at("hard.h5"));
  EXPECT_GT(flexions.size(), 100U);
  EXPECT_GT(flexions.back(), 90);
}

// At 0.2167 s and 98 degrees the lateral compartment opens with neither speed nor acceleration. The
// motion goes on, to where the medial contact leaves the upper end of its condyle.
TEST_F(SimulateCommand, ACompartmentThatOpensGentlyEndsNoMotion) {
  write("gentle.toml", hard_blow(110));
  const Outcome outcome = run("simulate gentle.toml -o gentle.h5");
  EXPECT_EQ(outcome.err.find("without end"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("beyond the edge"), std::string::npos) << outcome.err;
  EXPECT_GT(flexions_of(at("gentle.h5")).back(), 125);
}

// A scene may hold both tables; each command does its own.
TEST_F(SimulateCommand, ASceneMayBeSweptAndSimulated) {
  std::string both =
      with(kSmallScene, "start.rotation = [0, 0, 0]\n", "start.rotation = [0, 0, 0]\n" + kMass);
  both += "\n[simulate]\ntime = 0.02\nrate = 50\nflexion = 10\n";
  write("both.toml", both);
  const Outcome motion = run("simulate both.toml -o motion.h5");
  ASSERT_EQ(motion.code, 0) << motion.err;
  const Outcome sweep = run("sweep both.toml -o sweep.h5");
  ASSERT_EQ(sweep.code, 0) << sweep.err;
  const condyle::Run moved = read_run(at("motion.h5")), swept = read_run(at("sweep.h5"));
  EXPECT_EQ(moved.scene.text, swept.scene.text);
  EXPECT_EQ(moved.kind(), RunKind::kSimulation);
  EXPECT_EQ(swept.kind(), RunKind::kSweep);
  EXPECT_EQ(swept_quantity(moved).name, "time");
  EXPECT_EQ(swept_quantity(swept).name, "bend");
  EXPECT_NEAR(moved.sweep.poses.back().value, 0.02, 1e-12);
  EXPECT_EQ(swept.simulation(), nullptr);
}

// The numbers that the scene gives: a leg of 4 kg.
TEST_F(SimulateCommand, CheckSaysTheMass) {
  const Outcome outcome = run("check '" CONDYLE_SOURCE_DIR "/data/phantom/blow.toml'");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find(
                "mass       tibia: 4 kg, centre (0, -240, 0) mm, principal moments 6000, 1.1e+05, "
                "1.1e+05 kg mm^2"),
            std::string::npos)
      << outcome.out;
}

/// Kinetic energies [J].
std::vector<double> kinetic(const std::filesystem::path& file) {
  const Hdf5Reader reader(file);
  return reader.root().open("simulate").open("energy").read("kinetic", {6});
}

// A load says how large it is by its vector or by its scale, and where it is driven by the drive alone.
TEST_F(SimulateCommand, AScaleActsOnce) {
  const std::string weight = "vector = [0, 100, 0]";
  write("plain.toml", released());
  write("scaled.toml", with(released(), weight, "vector = [0, 25, 0]\nscale = 4"));
  ASSERT_EQ(run("simulate plain.toml -o plain.h5").code, 0);
  ASSERT_EQ(run("simulate scaled.toml -o scaled.h5").code, 0);
  const std::string drive =
      "drive = [{ load = \"weight\", shape = \"table\", times = [0, 0.1], factors = [1, 2] }]\n";
  write("plain.toml", released(drive));
  write("scaled.toml", with(released(drive), weight, weight + "\nscale = 0"));
  ASSERT_EQ(run("simulate plain.toml -o plain_driven.h5").code, 0);
  ASSERT_EQ(run("simulate scaled.toml -o scaled_driven.h5").code, 0);
  for (const std::string kind : {"", "_driven"}) {
    const std::vector<double> plain = kinetic(at("plain" + kind + ".h5")),
                              scaled = kinetic(at("scaled" + kind + ".h5"));
    EXPECT_GT(plain.back(), 0);
    for (std::size_t i = 0; i < plain.size(); ++i)
      EXPECT_NEAR(scaled[i], plain[i], 1e-6 * plain.back()) << kind << i;
  }
}

TEST_F(SimulateCommand, BadInputIsNamed) {
  write("swing.toml", with(released(), kMass, ""));
  expect_bad_input(run("simulate swing.toml -o swing.h5"),
                   "swing.toml: [[body]] \"tibia\": has no mass, expected density, or mass, center "
                   "and inertia, for simulate");
  write("swing.toml", with(released(), "time = 0.1", "time = -1"));
  const Outcome negative = run("simulate swing.toml -o swing.h5");
  EXPECT_EQ(negative.code, 1);
  EXPECT_NE(negative.err.find("time = -1"), std::string::npos) << negative.err;
  write("swing.toml",
        released("drive = [{ load = \"nobody\", shape = \"pulse\", duration = 1 }]\n"));
  const Outcome drive = run("simulate swing.toml -o swing.h5");
  EXPECT_EQ(drive.code, 1);
  EXPECT_NE(drive.err.find("nobody"), std::string::npos) << drive.err;
  write("open.stl",
        "solid open\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9 0 0\n"
        "vertex 0 9 0\nendloop\nendfacet\nendsolid open\n");
  write("swing.toml", with(released(), kMass, "mesh = \"open.stl\"\ndensity = 1.9e-6\n"));
  const Outcome open = run("simulate swing.toml -o swing.h5");
  EXPECT_EQ(open.code, 1);
  EXPECT_NE(open.err.find("expected a closed mesh for its mass"), std::string::npos) << open.err;
  write("swing.toml", released("hold = [\"bend\"]\nflexion_velocity = 10\n"));
  const Outcome held = run("simulate swing.toml -o swing.h5");
  EXPECT_EQ(held.code, 1);
  EXPECT_NE(
      held.err.find("flexion_velocity = 10, expected none, or a flexion that hold does not keep"),
      std::string::npos)
      << held.err;
  write("swing.toml", released("tolerance = 1\n"));
  EXPECT_NE(run("simulate swing.toml -o swing.h5")
                .err.find("tolerance = 1, expected a tolerance from 1e-13 to 1e-3"),
            std::string::npos);
  const Outcome none = run("simulate knee.toml -o swing.h5");
  expect_bad_input(none, "knee.toml: [simulate] is missing, expected time, rate and gravity");
}

// Before the start nothing has struck yet, be the blow at the start itself or a moment later.
TEST_F(SimulateCommand, APulseAtTheStartIsABlow) {
  std::vector<std::vector<double>> courses;
  for (const char* start : {"0", "1e-9"}) {
    write("blow.toml",
          released(fmt::format(
              "drive = [{{ load = \"kick\", shape = \"pulse\", start = {}, duration = "
              "0.05 }}]\n[[load]]\nname = \"kick\"\nbody = \"tibia\"\nkind = \"moment\"\n"
              "vector = [0, 0, 20000]\n",
              start)));
    const Outcome outcome = run("simulate blow.toml -o blow.h5");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    courses.push_back(flexions_of(at("blow.h5")));
  }
  ASSERT_EQ(courses[0].size(), courses[1].size());
  for (std::size_t i = 0; i < courses[0].size(); ++i)
    EXPECT_NEAR(courses[0][i], courses[1][i], 1e-4) << i;
  EXPECT_GT(std::abs(courses[0].back() - courses[0].front()), 1);
}

}  // namespace
}  // namespace condyle::test
