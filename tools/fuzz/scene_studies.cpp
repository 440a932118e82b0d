#include "fuzz/scene_studies.h"

#include <fmt/format.h>

namespace condyle::fuzz {
namespace {

const std::vector<std::string> kNumbers = {"reference_strain",  "slack_length", "stiffness",
                                           "transition_strain", "insertion.B",  "insertion.A"};

void sweep(SceneLines& out, const SceneNames& names) {
  const bool load = !names.loads.empty() && (names.conditions.empty() || out.choices().once_in(3));
  if (!load && names.conditions.empty()) return;
  out.table("[sweep]");
  std::string vary = out.word(load ? names.loads : names.conditions);
  if (load) vary.insert(vary.size() - 1, ".scale");
  out.line("vary", vary);
  if (out.choices().once_in(2)) {
    out.line("values", out.list({out.number(-5, 30), out.number(-5, 60), out.number(0, 90)}));
  } else {
    out.line("from", out.number(-5, 5));
    out.line("to", out.number(10, 40));
    out.line("step", "10");
  }
  if (!out.wild()) return;
  out.perhaps("path", out.word({"steps", "arc length"}));
  if (!out.choices().once_in(2)) return;
  const std::string owner = out.word(names.ligaments);
  const std::string& number = kNumbers[out.choices().below(kNumbers.size())];
  out.line("sensitivities",
           fmt::format("[{}.{}\", \"*.stiffness\"]", owner.substr(0, owner.size() - 1), number));
}

void laxity(SceneLines& out, const SceneNames& names) {
  out.table("[laxity]");
  out.line("flexion", out.list({"0", out.number(10, 90)}));
  out.line("cut", out.list({out.word(names.ligaments)}));
}

void simulate(SceneLines& out, const SceneNames& names) {
  out.table("[simulate]");
  out.line("time", out.number(0.01, 0.2));
  out.perhaps("rate", out.number(10, 500));
  out.perhaps("gravity", out.vector(10000));
  out.perhaps("flexion", out.number(0, 30));
  out.perhaps("flexion_velocity", out.number(-10, 10));
  out.perhaps("hold", out.list({out.word(names.conditions)}));
  out.perhaps("restitution", out.number(0, 1));
  out.perhaps("tolerance", "1e-6");
  out.perhaps("viscous_time", out.number(0, 0.1));
  const std::string load = out.word(names.loads);
  const char* const shapes[] = {"shape = \"pulse\", start = 0.01, duration = 0.02",
                                "shape = \"decaying sine\", start = 0, frequency = 5, decay = 3",
                                "shape = \"table\", times = [0, 0.1], factors = [1, 2]"};
  out.perhaps("drive", fmt::format("[{{ load = {}, {} }}]", load, out.choices().of(shapes)));
  const std::string coefficient = out.number(0, 2),
                    ends = out.ends({out.vector(40), out.vector(40)});
  out.perhaps("damper", fmt::format("[{{ name = \"oil\", coefficient = {}, ends = {} }}]",
                                    coefficient, ends));
}

void calibrate(SceneLines& out, const SceneNames& names) {
  out.table("[calibrate]");
  out.line("measurements", "\"knee.csv\"");
  out.line("moment", out.word({"N m", "N cm", "N mm"}));
  out.perhaps("specimen", "\"left\"");
  out.perhaps("relative", "[\"ap\"]");
  out.perhaps("huber", out.number(1, 3));
  out.perhaps("curve_sd", "[1, 1]");
  out.perhaps("frame_sd", "{ femur = [1, 2], tibia = [1, 2] }");
  out.perhaps("flexion_sd", out.number(0, 2));
  out.perhaps("level_sd", out.number(0, 0.2));
  out.perhaps("starts", out.number(1, 9));
  out.perhaps("samples", "100");
  out.perhaps("seed", out.number(0, 255));
  out.table("[[calibrate.load]]");
  out.line("name", "\"anterior\"");
  const bool held = out.choices().once_in(2);
  out.line(held ? "condition" : "load", out.word(held ? names.conditions : names.loads));
  for (std::size_t i = out.choices().below(3); i > 0; --i) {
    out.table("[[calibrate.parameter]]");
    out.line("what", out.quoted(kNumbers[out.choices().below(kNumbers.size())]));
    out.line("of", out.choices().once_in(2) ? "\"*\"" : out.list({out.word(names.ligaments)}));
    out.line("prior_sd", out.number(0.01, 2));
    out.perhaps("normal_sd", out.number(0, 1));
    out.perhaps("bounds", out.list({out.number(-1, 0.5), out.number(0.6, 9)}));
    out.perhaps("together",
                out.word({"x"}) == "\"x\"" && out.choices().once_in(2) ? "true" : "false");
  }
}

}  // namespace

void add_studies(SceneLines& out, const SceneNames& names) {
  sweep(out, names);
  if (!out.wild()) return;
  if (out.choices().once_in(4)) laxity(out, names);
  if (out.choices().once_in(4)) simulate(out, names);
  if (out.choices().once_in(4)) calibrate(out, names);
}

}  // namespace condyle::fuzz
