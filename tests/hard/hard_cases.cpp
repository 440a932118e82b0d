#include "hard/hard_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hard/truths.h"

namespace condyle::hard {
namespace {

using Changes = std::vector<std::pair<std::string, std::string>>;

std::string number(double x) { return fmt::format("{:.17g}", x); }

HardCase conforming(double ratio, double unit, const char* name, const char* why) {
  const double R = 10 * unit, r = R / ratio;
  return {name,
          "conforming.toml",
          {{"radius = 10\n", "radius = " + number(R) + "\n"},
           {"radius = 9\n", "radius = " + number(r) + "\n"},
           {"[0, 0, -0.5]", fmt::format("[0, 0, {}]", number(-0.5 * (R - r)))},
           {"at = [0, 0, -4]", fmt::format("at = [0, 0, {}]", number(-4 * unit))},
           {"at = [0, 0, -4]", fmt::format("at = [0, 0, {}]", number(-4 * unit))}},
          why,
          "cccccc",
          1e-11,
          [=](const SweepResult& sweep) { return ball_in_cup(sweep, R, r); },
          ""};
}

HardCase leaning_guide(double lean, const char* name) {
  // The answer is certain to the tolerance of 1e-12 over the angle between the two.
  const double value = (lean + 10) / std::sqrt(1 + lean * lean);
  return {name,
          "dependent.toml",
          {{"[1e-3, 0, 1]", fmt::format("[{}, 0, 1]", number(lean))},
           {"10.000994999505000", number(value)}},
          "a contact and a condition that nearly coincide: right to round-off over their angle",
          "cc",
          1e-11 / lean,
          [](const SweepResult& sweep) { return guided_ball(sweep); },
          ""};
}

std::vector<HardCase> contact_cases() {
  return {
      conforming(1.1, 1, "cup 1.1", "a ball in a cup that is a tenth larger"),
      conforming(1.01, 1, "cup 1.01", "a hundredth larger"),
      conforming(1.001, 1, "cup 1.001", "a thousandth larger"),
      conforming(1.00001, 1, "cup 1.00001", "hardly larger: the relative curvature is 1e-6 per mm"),
      conforming(1.1, 1e6, "lengths in km", "ten kilometres: nothing may depend on the unit"),
      conforming(1.1, 1e-3, "lengths in um", "ten micrometres: nothing may depend on the unit"),
      {"cup 1",
       "conforming.toml",
       {{"radius = 9\n", "radius = 10\n"}},
       "exactly as large: nothing says where it touches, and that is said",
       "",
       0,
       [](const SweepResult& sweep) { return static_cast<double>(sweep.count_converged()); },
       "conform"},
      {"line",
       "line.toml",
       {},
       "a cylinder on a plane: carried by the ends of its line",
       "ccc",
       1e-10,
       roller,
       ""},
      {"pole",
       "pole.toml",
       {},
       "the contact passes the pole of an ellipsoid",
       std::string(13, 'c'),
       1e-11,
       rolling_stone,
       ""},
      {"two ridges",
       "two-ridges.toml",
       {},
       "the contact jumps from one place to another, at x = 0",
       "ccccccc",
       1e-9,
       ball_over_ridges,
       ""},
      {"rocking",
       "rocking.toml",
       {},
       "one contact opens where another closes, at 0 degrees",
       "cccccc",
       1e-9,
       dumbbell,
       ""},
      {"four contacts",
       "four-contacts.toml",
       {},
       "four at once, each with W/(2 sqrt 2)",
       "ccc",
       1e-10,
       sledge,
       ""},
      {"20 mm off",
       "far-start.toml",
       {},
       "a start 20 mm above the floor",
       "c",
       1e-9,
       hooked_ball,
       ""},
      {"5 mm inside",
       "far-start.toml",
       {{"[2, -1, 30]", "[2, -1, 5]"}},
       "a start 5 mm inside the floor",
       "c",
       1e-9,
       hooked_ball,
       ""},
      {"leaving",
       "leaving-patch.toml",
       {},
       "the contact leaves the known surface, at 10 + 5 sin(atan 0.2) mm",
       "ccccccll",
       1e-9,
       ball_on_dome,
       "beyond the known part"},
      {"two pits",
       "two-pits.toml",
       {},
       "two equal answers: the nearer one to the pose before, until it ends",
       "cccccccc",
       1e-9,
       ball_in_pits,
       ""},
  };
}

std::vector<HardCase> element_cases() {
  return {
      {"all slack",
       "slack.toml",
       {},
       "nothing pulls: the start, called neutral",
       "ccc",
       1e-12,
       slack_bone,
       "nothing resists"},
      {"toe's corner",
       "toe-corner.toml",
       {},
       "the stiffness has a corner at the answer",
       "ccccccc",
       1e-11,
       hanging_weight,
       ""},
      {"short element",
       "short-element.toml",
       {},
       "down to 1e-9 mm right, without length named",
       "ccccz",
       1e-11,
       short_spring,
       "has no length"},
      {"stiffness 1e9",
       "stiffness-ratio.toml",
       {},
       "a ratio of 1e9 between two springs",
       "ccccc",
       1e-11,
       block_between_walls,
       ""},
      {"snap-through",
       "snap-through.toml",
       {},
       "the load has a greatest value, and beyond it the truss hangs",
       std::string(13, 'c'),
       1e-8,
       snapping_truss,
       ""},
      {"past the limit",
       "snap-through.toml",
       {{"step = 1\n", "step = 1\npath = \"arc length\"\n"}},
       "the same along the path, through the limit points",
       "",
       1e-9,
       path_of_truss,
       ""},
      {"bifurcation",
       "bifurcation.toml",
       {},
       "upright under every load, stable below 160 N only",
       "cccccccc",
       1e-11,
       column,
       "unstable along a rotation"},
      {"turning load",
       "turning-load.toml",
       {},
       "a load that dies away and comes back upside down",
       "ccccccc",
       1e-11,
       bob,
       "nothing resists"},
  };
}

std::vector<HardCase> motion_cases() {
  return {
      leaning_guide(1e-3, "guide 1e-3"),
      leaning_guide(1e-6, "guide 1e-6"),
      {"guide 1e-9",
       "dependent.toml",
       {{"[1e-3, 0, 1]", "[1e-9, 0, 1]"}, {"10.000994999505000", "10.000000001"}},
       "so near that the pose is not known to a hundredth of a millimetre: refused",
       "ss",
       0,
       nullptr,
       "nothing resists"},
      {"guide 0",
       "dependent.toml",
       {{"[1e-3, 0, 1]", "[0, 0, 1]"},
        {"10.000994999505000", "10"},
        {"\"translation y\"\nkind",
         "\"translation x\"\nkind = \"translation\"\naxis = \"x\"\n"
         "value = 0\n\n[[condition]]\nname = \"translation y\"\nkind"}},
       "a contact and a condition that coincide: the contact stays open, the condition carries",
       "cc",
       1e-11,
       held_ball,
       ""},
      {"Cardan 90",
       "cardan.toml",
       {},
       "an angle that turns back at 90 degrees; beyond, nothing has it",
       "ccccccn",
       1e-9,
       wheel,
       "turns back at 90"},
      {"one step",
       "one-step.toml",
       {},
       "120 degrees at once, the same as in steps of 5",
       "cc",
       1e-11,
       nullptr,
       ""},
  };
}

}  // namespace

std::vector<HardCase> hard_cases() {
  std::vector<HardCase> all = contact_cases();
  for (const std::vector<HardCase>& more : {element_cases(), motion_cases()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace condyle::hard
