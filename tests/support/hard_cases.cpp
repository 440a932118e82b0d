#include "support/hard_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "support/truths.h"

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
          "it touches where the load points, right to round-off",
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
          fmt::format("a contact and a condition {:.0e} from coinciding", lean),
          "right to round-off over that angle",
          "cc",
          1e-11 / lean,
          [](const SweepResult& sweep) { return guided_ball(sweep); },
          ""};
}

std::vector<HardCase> cups() {
  return {
      conforming(1.1, 1, "cup 1.1", "a ball in a cup that is a tenth larger"),
      conforming(1.01, 1, "cup 1.01", "a hundredth larger"),
      conforming(1.001, 1, "cup 1.001", "a thousandth larger"),
      conforming(1.00001, 1, "cup 1.00001", "hardly larger: the relative curvature is 1e-6 per mm"),
      {"cup 1",
       "conforming.toml",
       {{"radius = 9\n", "radius = 10\n"}},
       "exactly as large: rigid surfaces do not say where they touch",
       "refused, and called conforming",
       "[si]{6}",
       0,
       nullptr,
       "conform"},
      conforming(1.1, 1e6, "lengths in km", "the cup ten kilometres wide"),
      conforming(1.1, 1e-3, "lengths in um", "the cup ten micrometres wide"),
  };
}

std::vector<HardCase> contact_cases() {
  return {
      {"line",
       "line.toml",
       {},
       "a cylinder on a plane: contact along a line",
       "carried by the line's two ends",
       "ccc",
       1e-10,
       roller,
       ""},
      {"pole",
       "pole.toml",
       {},
       "the contact passes the pole of an ellipsoid",
       "passes as anywhere else: no chart has a pole here",
       "c{13}",
       1e-11,
       rolling_stone,
       ""},
      {"two ridges",
       "two-ridges.toml",
       {},
       "the contact jumps from one facet of the floor to another, at x = 0",
       "touches the right one, and the event tells where it jumps",
       "c{7}",
       1e-9,
       ball_over_ridges,
       ""},
      {"rocking",
       "rocking.toml",
       {},
       "one contact opens where another closes, at 0 degrees",
       "one of the two carries, and both events lie at 0",
       "c{6}",
       1e-9,
       dumbbell,
       ""},
      {"four contacts",
       "four-contacts.toml",
       {},
       "four contacts at once",
       "each carries W/(2 sqrt 2)",
       "ccc",
       1e-10,
       sledge,
       ""},
      {"20 mm off",
       "far-start.toml",
       {},
       "a start 20 mm above the floor",
       "found",
       "c",
       1e-9,
       hooked_ball,
       ""},
      {"5 mm inside",
       "far-start.toml",
       {{"[2, -1, 30]", "[2, -1, 5]"}},
       "a start 5 mm inside the floor",
       "found",
       "c",
       1e-9,
       hooked_ball,
       ""},
      {"leaving",
       "leaving-patch.toml",
       {},
       "the contact leaves the known surface, at 10 + 5 sin(atan 0.2) mm",
       "right before; beyond refused, and the event tells where",
       "c{6}ll",
       1e-9,
       ball_on_dome,
       "beyond the known part"},
      {"two pits",
       "two-pits.toml",
       {},
       "two equal answers",
       "the nearer one to the pose before, until it ends",
       "c{8}",
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
       "all ligaments are slack: nothing pulls",
       "stays at the start, called neutral",
       "ccc",
       1e-12,
       slack_bone,
       "nothing resists"},
      {"toe's corner",
       "toe-corner.toml",
       {},
       "a ligament at its toe's end: the stiffness has a corner at the answer",
       "right to round-off on either side and at it",
       "c{7}",
       1e-11,
       hanging_weight,
       ""},
      {"short element",
       "short-element.toml",
       {},
       "an element down to 1e-9 mm long, then of no length",
       "right; without length it is named",
       "ccccz",
       1e-11,
       short_spring,
       "has no length"},
      {"stiffness 1e9",
       "stiffness-ratio.toml",
       {},
       "two springs, one 1e9 times stiffer",
       "the pose right to round-off",
       "c{5}",
       1e-11,
       block_between_walls,
       ""},
  };
}

std::vector<HardCase> path_cases() {
  return {
      {"snap-through",
       "snap-through.toml",
       {},
       "the load has a greatest value; beyond it the truss hangs",
       "goes over to the hanging answer, and the event tells where",
       "c{13}",
       1e-8,
       snapping_truss,
       ""},
      {"past the limit",
       "snap-through.toml",
       {{"step = 1\n", "step = 1\npath = \"arc length\"\n"}},
       "the same along the path of equilibria, which turns back twice",
       "all of it followed, through both limit points",
       "c+",
       1e-9,
       path_of_truss,
       ""},
      {"bifurcation",
       "bifurcation.toml",
       {},
       "a symmetric column under a load that grows past 160 N",
       "stays upright, called unstable beyond 160 N",
       "c{8}",
       1e-11,
       column,
       "unstable along a rotation"},
      {"turning load",
       "turning-load.toml",
       {},
       "a load that dies away and comes back upside down: at 0 every pose is one",
       "hangs on, called neutral at 0 and unstable beyond",
       "c{7}",
       1e-11,
       bob,
       "nothing resists"},
      {"swinging load",
       "turning-load.toml",
       {{"vector = [0, 0, 10]\n",
         "vector = [0, 0, 10]\n\n[[load]]\nname = \"side\"\nbody = \"bob\"\nkind = \"force\"\n"
         "vector = [0.01, 0, 0]\n"}},
       "the same beside a load of a thousandth: its direction turns by half a turn about 0, where "
       "hardly anything resists",
       "the bob points along the load",
       "c{7}",
       1e-9,
       swinging_bob,
       ""},
  };
}

std::vector<HardCase> motion_cases() {
  return {
      leaning_guide(1e-3, "guide 1e-3"),
      leaning_guide(1e-6, "guide 1e-6"),
      {"guide 1e-9",
       "dependent.toml",
       {{"[1e-3, 0, 1]", "[1e-9, 0, 1]"}, {"10.000994999505000", "10.000000001"}},
       "1e-09 from coinciding: round-off moves the pose by a hundredth of a millimetre",
       "refused, with the motion that nothing resists",
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
       "a contact and a condition that coincide: how they share the load is open",
       "the contact stays open, the condition carries",
       "cc",
       1e-11,
       held_ball,
       ""},
      {"Cardan 90",
       "cardan.toml",
       {},
       "an angle that turns back at 90 degrees",
       "right up to 90 degrees; beyond, said that nothing has it",
       "c{6}n",
       1e-9,
       wheel,
       "turns back at 90"},
      {"one step",
       "one-step.toml",
       {},
       "a knee from 0 to 120 degrees at once",
       "where 24 small steps lead",
       "cc",
       1e-10,
       nullptr,
       "",
       24},
  };
}

}  // namespace

std::vector<HardCase> hard_cases() {
  std::vector<HardCase> all = cups();
  for (const std::vector<HardCase>& more :
       {contact_cases(), element_cases(), path_cases(), motion_cases()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace condyle::hard
