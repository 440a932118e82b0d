/// Elastic layers as a user meets them: a scene file, the sweep, the result file. Balls, sockets and
/// planes against closed forms: K = E (1 - ν)/((1 + ν)(1 - 2ν)), two layers of 3 mm with E = 10
/// N/mm² and ν = 0.45 in series have k = 6.321839080459770 N/mm³.

#include <fmt/format.h>

#include <cmath>

#include "app/run_program.h"
#include "condyle/results/run_file.h"

namespace condyle {
namespace {

using test::expect_bad_input;

constexpr const char* kLayer = "modulus = 10\npoisson = 0.45\nlayer = 3\n";

/// A moving body that is held in every direction and pressed down by `depths`, from where it
/// touches at `height`.
std::string pressed_scene(const std::string& on_fixed,
                          const std::string& on_moving,
                          double height,
                          const std::vector<double>& depths,
                          const std::string& contact = "tolerance = 1e-5\n") {
  std::string text = R"(title = "pressed"
[units]
length = "mm"
angle = "deg"
force = "N"
[[body]]
name = "block"
fixed = true
[[body]]
name = "ball"
)";
  text += fmt::format("start.translation = [0, 0, {}]\n", height - depths.front());
  text += "[[surface]]\nname = \"below\"\nbody = \"block\"\n" + on_fixed + kLayer;
  text += "[[surface]]\nname = \"above\"\nbody = \"ball\"\n" + on_moving + kLayer;
  text += "[[contact]]\nname = \"pad\"\nsurfaces = [\"below\", \"above\"]\nlaw = \"layer\"\n";
  text += contact;
  for (const char* axis : {"x", "y", "z"})
    text += fmt::format(
        "[[condition]]\nname = \"turn {0}\"\nkind = \"rotation\"\naxis = \"{0}\"\nvalue = 0\n"
        "[[condition]]\nname = \"move {0}\"\nkind = \"translation\"\naxis = \"{0}\"\nvalue = 0\n",
        axis);
  text += "[sweep]\nvary = \"move z\"\nvalues = [";
  for (const double depth : depths) text += fmt::format("{}, ", height - depth);
  return text + "]\n";
}

constexpr const char* kEndlessPlane = "kind = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n";
const std::string kPlane = std::string(kEndlessPlane) + "radius = 15\n";
constexpr const char* kBall30 = "kind = \"sphere\"\ncenter = [0, 0, 0]\nradius = 30\n";

class LayerCommand : public test::CommandLine {
 protected:
  [[nodiscard]] condyle::Run swept(const std::string& scene, int code = 0) const {
    write("layer.toml", scene);
    const test::Outcome outcome = run("sweep layer.toml -o layer.h5");
    EXPECT_EQ(outcome.code, code) << outcome.err << outcome.out;
    return read_run(at("layer.h5"));
  }
};

TEST_F(LayerCommand, ABallOnAPlaneCarriesTheMeanOfBothSides) {
  const condyle::Run result = swept(pressed_scene(kPlane, kBall30, 30, {0.5}));
  const PoseResult& pose = result.sweep.poses.at(0);
  ASSERT_TRUE(pose.converged()) << pose.reason;
  const ContactResult& contact = pose.contacts[0];
  ASSERT_TRUE(contact.closed && contact.layer);
  const LayerResult& layer = *contact.layer;
  EXPECT_NEAR(contact.force, 147.7135339, 2e-4 * 147);
  EXPECT_NEAR(pose.conditions[5].multiplier, 147.7135339, 2e-4 * 147);
  EXPECT_NEAR(layer.energy, (24.82580402 + 24.51548147) / 2, 1e-4 * 24);
  EXPECT_NEAR(layer.area, (94.24777961 + 93.46238144) / 2, 2e-2 * 94);
  EXPECT_NEAR(layer.peak_pressure, 3.160919540, 1e-2);
  EXPECT_NEAR(layer.mean_pressure, contact.force / layer.area, 0.02 * layer.mean_pressure);
  EXPECT_NEAR(layer.deepest, 0.5, 2e-3);
  EXPECT_NEAR(contact.resultant_ground.head<2>().norm(), 0, 1e-3);
  EXPECT_NEAR(layer.force.z(), contact.force, 1e-9);
  EXPECT_NEAR(layer.moment.norm(), 0, 0.02);
  EXPECT_EQ(layer.lost, 0);
  // h sqrt(K/3μ) = 5.745 mm of one layer, over the radius of the area.
  EXPECT_NEAR(layer.lateral, 5.745 / std::sqrt(layer.area / M_PI), 2e-3);
}

TEST_F(LayerCommand, ClosedFormsOfOtherShapes) {
  struct Case {
    std::string below, above;
    double height, depth, force;
  };
  const std::string socket =
      "kind = \"sphere\"\ncenter = [0, 0, 0]\nradius = 32\nsolid = \"outside\"\n";
  const std::string ball20 = "kind = \"sphere\"\ncenter = [0, 0, 0]\nradius = 20\n";
  const std::string ellipsoid =
      "kind = \"ellipsoid\"\ncenter = [0, 0, 0]\nsemi_axes = [35, 25, 22]\n";
  const std::string paraboloid =
      "kind = \"polynomial\"\nradius = 15\nframe = { axes = [[1, 0, 0], [0, -1, 0], [0, 0, -1]] }\n"
      "coefficients = [[2, 0, -0.016666666666666666], [0, 2, -0.025]]\n";
  const std::vector<Case> cases = {
      {kEndlessPlane, kBall30, 30, 0.5, 148.9548241},
      {socket, kBall30, -2, 0.5, (1807.815048 + 1749.325454) / 2},
      {kBall30, ball20, 50, 0.5, (58.87801259 + 59.38081048) / 2},
      {kEndlessPlane, ellipsoid, 22, 0.6, 283.2988038},
      {kEndlessPlane, paraboloid, 0, 0.5, 122.4612659},
  };
  for (const Case& c : cases) {
    const condyle::Run result = swept(pressed_scene(c.below, c.above, c.height, {c.depth}));
    ASSERT_TRUE(result.sweep.poses[0].converged()) << c.above << result.sweep.poses[0].reason;
    EXPECT_NEAR(result.sweep.poses[0].contacts[0].force, c.force, 5e-4 * c.force) << c.above;
  }
}

TEST_F(LayerCommand, TheLogarithmicLawStiffens) {
  const condyle::Run result = swept(
      pressed_scene(kEndlessPlane, kBall30, 30, {0.5, 1.5, 3}, "pressure = \"logarithmic\"\n"));
  const std::vector<double> forces = {153.2739889, 1468.794715, 6581.837915};
  for (std::size_t i = 0; i < forces.size(); ++i)
    EXPECT_NEAR(result.sweep.poses[i].contacts[0].force, forces[i], 1e-3 * forces[i]);
}

TEST_F(LayerCommand, TheFieldAddsUpToTheForceAndReadsBack) {
  const condyle::Run result = swept(pressed_scene(kPlane, kBall30, 30, {-1, 0.3, 0.6}));
  EXPECT_FALSE(result.sweep.poses[0].contacts[0].closed);
  EXPECT_NEAR(result.sweep.poses[0].contacts[0].points.at(0).gap, 1, 1e-9);
  for (const std::size_t i : {1, 2}) {
    const ContactResult& contact = result.sweep.poses[i].contacts[0];
    double force = 0, area = 0;
    for (const PressurePoint& p : contact.pressures) {
      force += 0.5 * p.pressure * p.area;
      area += 0.5 * p.area;
      // On the ball about (0, 0, 0), or on the plane z = 0.
      EXPECT_NEAR(p.on_A ? p.point.norm() - 30 : p.point.z(), 0, 1e-9);
      EXPECT_NEAR(p.pressure, 6.321839080459770 * p.depth, 1e-9);
    }
    EXPECT_EQ(static_cast<int>(contact.pressures.size()), contact.layer->points);
    EXPECT_NEAR(area, contact.layer->area, 1e-9 * area);
    EXPECT_NEAR(force, contact.layer->mean_pressure * contact.layer->area, 1e-9 * force);
  }
  ASSERT_EQ(result.sweep.events.size(), 1U);
  EXPECT_EQ(result.sweep.events[0].kind, EventKind::kClosing);
  EXPECT_NEAR(result.sweep.events[0].value, 30, 1e-3);
}

TEST_F(LayerCommand, PressedBeyondWhatItBearsIsAStatusWithThePlace) {
  const condyle::Run result = swept(pressed_scene(kEndlessPlane, kBall30, 30, {1, 3.5}), 2);
  EXPECT_TRUE(result.sweep.poses[0].converged());
  EXPECT_EQ(result.sweep.poses[1].status, PoseStatus::kOverlap);
  EXPECT_EQ(result.sweep.poses[1].reason.substr(0, 42),
            "contact \"pad\" is pressed 3.50 mm deep at [");
}

TEST_F(LayerCommand, ResumesWithTheSameNumbers) {
  const std::string scene = pressed_scene(kPlane, kBall30, 30, {0.2, 0.4, 0.6});
  const condyle::Run first = swept(scene);
  const test::Outcome outcome = run("sweep layer.toml -o layer.h5 --resume");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("3 poses taken over, 0 computed"), std::string::npos) << outcome.out;
  const condyle::Run again = read_run(at("layer.h5"));
  for (std::size_t i = 0; i < 3; ++i) {
    const ContactResult &a = first.sweep.poses[i].contacts[0],
                        &b = again.sweep.poses[i].contacts[0];
    EXPECT_NEAR(a.force, b.force, 1e-9 * a.force);
    ASSERT_EQ(a.pressures.size(), b.pressures.size());
    EXPECT_NEAR(a.layer->energy, b.layer->energy, 1e-9 * a.layer->energy);
  }
}

}  // namespace
}  // namespace condyle
