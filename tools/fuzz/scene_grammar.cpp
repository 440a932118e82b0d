#include "fuzz/scene_grammar.h"

#include <fmt/format.h>

#include "fuzz/scene_lines.h"
#include "fuzz/scene_studies.h"

namespace condyle::fuzz {
namespace {

using Words = std::vector<std::string>;

void units(SceneLines& out) {
  out.line("title", out.quoted("made up"));
  out.table("[units]");
  const bool tame = !out.wild();
  out.line("length", tame ? "\"mm\"" : out.word({"mm", "mm", "mm", "cm", "m"}));
  out.line("angle", tame ? "\"deg\"" : out.word({"deg", "deg", "rad"}));
  out.line("force", "\"N\"");
}

void bodies(SceneLines& out) {
  out.table("[[body]]");
  out.line("name", "\"B\"");
  out.line("fixed", "true");
  out.table("[[body]]");
  out.line("name", "\"A\"");
  if (out.choices().once_in(2)) {
    out.line("start.translation", out.vector(4));
    out.line("start.rotation", out.vector(8));
  }
  if (out.choices().once_in(4)) {
    out.line("mass", out.number(0.5, 5));
    out.line("center", out.vector(20));
    out.line("inertia", "[[9000, 0, 0], [0, 8000, 100], [0, 100, 5000]]");
  }
}

bool joint(SceneLines& out) {
  if (!out.choices().once_in(2)) return false;
  out.table("[joint]");
  out.line("side", out.word({"right", "left"}));
  const bool left = out.wild() && out.choices().once_in(2);
  for (const char* bone : {"femur", "tibia"})
    out.line(bone,
             fmt::format("{{ body = \"{}\", origin = {}, lateral = [{}, 0, 0], anterior = [0, "
                         "1, 0], proximal = [0, 0, 1] }}",
                         bone[0] == 'f' ? "B" : "A", out.vector(1), left ? -1 : 1));
  return true;
}

void layer(SceneLines& out) {
  out.line("modulus", out.number(1, 20));
  out.line("poisson", out.number(0.1, 0.48));
  out.line("layer", out.number(0.5, 4));
}

/// Of the fixed body, its top about (x, y, 0).
void floor_at(SceneLines& out, const std::string& name, double x, double y, bool soft) {
  out.table("[[surface]]");
  out.line("name", name);
  out.line("body", "\"B\"");
  const std::size_t kind = out.choices().below(6);
  const char* const kinds[] = {"plane", "sphere", "sphere", "cylinder", "ellipsoid", "polynomial"};
  out.line("kind", out.quoted(kinds[kind]));
  if (kind == 0) {
    out.line("point", out.point(x, y, 0, 1));
    out.line("normal", out.direction(0, 0, 1));
    out.perhaps("radius", out.number(15, 60));
  } else if (kind == 1) {  // a cup
    out.line("center", out.point(x, y, 42, 1));
    out.line("radius", out.number(40, 44));
    out.line("solid", "\"outside\"");
  } else if (kind == 2) {
    out.line("center", out.point(x, y, -42, 1));
    out.line("radius", out.number(40, 44));
  } else if (kind == 3) {
    out.line("point", out.point(x, y, -30, 1));
    out.line("axis", out.direction(1, 0, 0));
    out.line("radius", out.number(28, 32));
    out.line("length", out.number(30, 60));
  } else if (kind == 4) {
    out.line("center", out.point(x, y, -25, 1));
    out.line("axes", out.vector(20));
    out.line("semi_axes", out.list({out.number(20, 40), out.number(20, 40), "25"}));
  } else {
    out.line("coefficients",
             out.list({out.list({"2", "0", out.number(-0.02, 0.02)}), "[0, 2, 0.01]",
                       out.list({"1", "1", out.number(-0.01, 0.01)})}));
    out.line("frame", fmt::format("{{ origin = [{}, {}, 0], axes = {} }}", x, y, out.vector(5)));
    out.line("radius", out.number(15, 40));
  }
  if (soft) layer(out);
}

/// Of the moving body, its bottom about (x, y, 0).
void bottom_at(SceneLines& out, const std::string& name, double x, double y, bool soft) {
  out.table("[[surface]]");
  out.line("name", name);
  out.line("body", "\"A\"");
  const std::size_t kind = out.choices().below(4);
  const char* const kinds[] = {"sphere", "ellipsoid", "cylinder", "torus"};
  out.line("kind", out.quoted(kinds[kind]));
  if (kind == 0 || kind == 1) out.line("center", out.point(x, y, 20, 1));
  if (kind == 0) out.line("radius", out.number(18, 22));
  if (kind == 1) {
    out.line("axes", out.vector(15));
    out.line("semi_axes", out.list({out.number(15, 25), out.number(15, 30), "20"}));
  }
  if (kind == 2) {
    out.line("point", out.point(x, y, 15, 1));
    out.line("axis", out.direction(0, 1, 0));
    out.line("radius", out.number(14, 16));
    out.line("length", out.number(10, 40));
  }
  if (kind == 3) {
    out.line("center", out.point(x, y, 25, 1));
    out.line("axis", out.direction(1, 0, 0));
    out.line("major", out.number(14, 18));
    out.line("minor", out.number(6, 9));
  }
  if (soft) layer(out);
}

Words contacts(SceneLines& out) {
  Words names;
  const std::size_t count = out.choices().below(4);
  const double places[3][2] = {{-20, 0}, {20, 0}, {0, 25}};
  for (std::size_t i = 0; i < count; ++i) {
    const bool soft = out.choices().once_in(4);
    const std::string floor = fmt::format("floor {}", i), bottom = fmt::format("bottom {}", i);
    floor_at(out, out.quoted(floor), places[i][0], places[i][1], soft);
    bottom_at(out, out.quoted(bottom), places[i][0], places[i][1], soft);
    names.push_back(fmt::format("contact {}", i));
    out.table("[[contact]]");
    out.line("name", out.quoted(names.back()));
    out.line("surfaces", fmt::format("[\"{}\", \"{}\"]", floor, bottom));
    if (soft) {
      out.line("law", "\"layer\"");
      out.perhaps("pressure", out.word({"linear", "logarithmic"}));
      out.perhaps("lost_force", out.number(0, 0.5));
    } else {
      out.perhaps("state", out.word({"auto", "closed", "open"}));
      out.perhaps("start", out.list({out.point(places[i][0], places[i][1], 0, 5)}));
    }
  }
  return names;
}

Words wraps(SceneLines& out) {
  Words names;
  const std::size_t count = out.choices().once_in(3) ? 1 + out.choices().below(2) : 0;
  for (std::size_t i = 0; i < count; ++i) {
    names.push_back(fmt::format("wrap {}", i));
    out.table("[[wrap]]");
    out.line("name", out.quoted(names.back()));
    out.line("body", out.word({"B", "A"}));
    const std::size_t kind = out.choices().below(4);
    const char* const kinds[] = {"sphere", "cylinder", "ellipsoid", "torus"};
    out.line("kind", out.quoted(kinds[kind]));
    out.line(kind == 1 ? "point" : "center", out.point(30, 0, 0, 8));
    if (kind < 2) out.line("radius", out.number(3, 12));
    if (kind == 1 || kind == 3) out.line("axis", out.direction(0, 1, 0));
    if (kind == 2) {
      out.line("axes", out.vector(30));
      out.line("semi_axes", out.list({out.number(4, 15), out.number(4, 15), "8"}));
    }
    if (kind == 3) {
      out.line("major", out.number(8, 12));
      out.line("minor", out.number(2, 5));
    }
  }
  return names;
}

void law(SceneLines& out) {
  const std::size_t kind = out.choices().below(5);
  const char* const laws[] = {"toe-linear", "toe-linear", "quadratic", "polynomial", "table"};
  out.line("law", out.quoted(laws[kind]));
  if (kind < 3) {
    out.line("stiffness", kind < 2 ? out.number(200, 6000) : out.number(1, 50));
    if (kind == 0) out.perhaps("transition_strain", out.number(0.01, 0.1));
    if (out.choices().once_in(3)) {
      out.line("slack_length", out.number(15, 60));
    } else {
      out.line("reference_strain", out.number(-0.1, 0.15));
      out.perhaps("reference_length", out.number(20, 60));
    }
  } else if (kind == 3) {
    out.line("coefficients", out.list({out.number(0, 5), out.number(0, 2)}));
    out.perhaps("tension_only", "true");
  } else {
    out.line("lengths", "[10, 30, 60]");
    out.line("forces", out.list({"0", out.number(0, 20), out.number(20, 400)}));
  }
}

Words ligaments(SceneLines& out, const Words& wraps) {
  Words names;
  const std::size_t count = out.choices().below(9);
  for (std::size_t i = 0; i < count; ++i) {
    names.push_back(fmt::format("tie {}", i));
    out.table("[[ligament]]");
    out.line("name", out.quoted(names.back()));
    out.line("ends", out.ends({out.point(0, 0, -20, 45), out.point(0, 0, 20, 45)}));
    law(out);
    if (wraps.empty() || !out.choices().once_in(2)) continue;
    out.line("wraps", out.list({out.word(wraps)}));
    out.perhaps("inside", out.word({"anchor", "straight"}));
    out.perhaps("side", out.point(35, 0, 0, 20));
    out.perhaps("thickness", out.number(0, 4));
  }
  return names;
}

Words loads(SceneLines& out) {
  Words names;
  const std::size_t count = out.choices().below(4);
  for (std::size_t i = 0; i < count; ++i) {
    names.push_back(fmt::format("load {}", i));
    const bool moment = out.choices().once_in(4);
    out.table("[[load]]");
    out.line("name", out.quoted(names.back()));
    out.line("body", "\"A\"");
    out.line("kind", moment ? "\"moment\"" : "\"force\"");
    out.line("vector", moment   ? out.vector(3000)
                       : i == 0 ? out.point(0, 0, -150, 40)
                                : out.vector(60));
    if (!moment) out.perhaps("at", out.vector(30));
    out.perhaps("follows", out.word({"ground", "body"}));
    if (i > 0) out.perhaps("scale", out.number(-1, 2));
  }
  return names;
}

Words conditions(SceneLines& out, bool has_joint) {
  const Words free = {"translation", "rotation", "distance"},
              all = {"flexion",       "adduction",       "internal_rotation",
                     "lateral_shift", "anterior_drawer", "distraction",
                     "translation",   "rotation",        "distance"};
  Words names;
  const std::size_t count = out.choices().below(4);
  for (std::size_t i = 0; i < count; ++i) {
    names.push_back(fmt::format("hold {}", i));
    const std::string kind = out.word(has_joint ? all : free);
    out.table("[[condition]]");
    out.line("name", out.quoted(names.back()));
    out.line("kind", kind);
    out.line("value", kind == "\"distance\"" ? out.number(20, 60) : out.number(-5, 10));
    if (kind == "\"translation\"" || kind == "\"rotation\"")
      out.line("axis", out.word({"x", "y", "z"}));
    if (kind == "\"distance\"") out.line("ends", out.ends({out.vector(30), out.vector(30)}));
  }
  return names;
}

}  // namespace

std::string made_scene(Choices& choices, Temper temper) {
  SceneLines out(choices, temper);
  SceneNames names;
  units(out);
  bodies(out);
  names.joint = joint(out);
  names.contacts = contacts(out);
  const Words wrapped = wraps(out);
  names.ligaments = ligaments(out, wrapped);
  names.loads = loads(out);
  names.conditions = conditions(out, names.joint);
  add_studies(out, names);
  return out.take();
}

}  // namespace condyle::fuzz
