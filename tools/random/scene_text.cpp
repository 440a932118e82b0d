#include "random/scene_text.h"

#include "condyle/scene_file/scene_words.h"
#include "random/scene_writer.h"

namespace condyle::random_knees {
namespace {

void write(Writer& out, const BodyDescription& body) {
  out.table("[[body]]");
  out.word("name", body.name);
  if (body.fixed) return out.line("fixed", "true");
  out.line("start.translation", out.place(body.start_translation));
  out.line("start.rotation", Writer::vector(body.start_rotation / out.scene.angle_to_rad));
}

void write(Writer& out, const char* name, const AnatomicalFrame& frame) {
  out.line(name,
           fmt::format("{{ body = {}, origin = {}, lateral = {}, anterior = {}, proximal = {} }}",
                       out.body(frame.body), out.place(frame.origin), Writer::vector(frame.lateral),
                       Writer::vector(frame.anterior), Writer::vector(frame.proximal)));
}

void write(Writer& out, const ContactDescription& contact) {
  out.table("[[contact]]");
  out.word("name", contact.name);
  const auto name = [&](int i) { return out.scene.surfaces[static_cast<std::size_t>(i)].name; };
  out.line("surfaces",
           fmt::format("[\"{}\", \"{}\"]", name(contact.surfaces[0]), name(contact.surfaces[1])));
  if (contact.state != ContactState::kAuto)
    out.word("state", contact.state == ContactState::kClosed ? "closed" : "open");
  if (contact.layer) {
    out.word("law", "layer");
    out.word("pressure",
             contact.layer->pressure == PressureLaw::kLinear ? "linear" : "logarithmic");
  }
}

void write(Writer& out, const ConditionDescription& condition) {
  static constexpr const char* kKinds[] = {"flexion",       "adduction",       "internal_rotation",
                                           "lateral_shift", "anterior_drawer", "distraction",
                                           "translation",   "rotation",        "distance"};
  out.table("[[condition]]");
  out.word("name", condition.name);
  out.word("kind", kKinds[static_cast<std::size_t>(condition.kind)]);
  out.line("value", is_angle(condition.kind)
                        ? Writer::number(condition.value / out.scene.angle_to_rad)
                        : out.length(condition.value));
  if (condition.kind == ConditionKind::kTranslation)
    out.line("axis", Writer::vector(condition.axis));
  if (condition.kind == ConditionKind::kRotation)
    out.word("axis", std::string(1, "xyz"[condition.cardan_axis]));
  if (condition.kind == ConditionKind::kDistance)
    out.line("ends",
             fmt::format("[{}, {}]", out.end(condition.ends[0]), out.end(condition.ends[1])));
}

void write(Writer& out, const LoadDescription& load) {
  out.table("[[load]]");
  out.word("name", load.name);
  out.line("body", out.body(load.body));
  out.word("kind", load.moment ? "moment" : "force");
  const double unit = out.scene.force_to_n * (load.moment ? out.scene.length_to_mm : 1);
  out.line("vector", Writer::vector(load.vector / unit));
  if (!load.moment) out.line("at", out.place(load.at));
  out.word("follows", load.follows_body ? "body" : "ground");
  if (load.scale != 1) out.line("scale", Writer::number(load.scale));
}

void write(Writer& out, const SweepDescription& sweep) {
  out.table("[sweep]");
  out.word("vary", sweep.vary);
  double unit = 1;
  if (!sweep.varies_load) {
    const ConditionDescription& varied =
        out.scene.conditions[static_cast<std::size_t>(sweep.index)];
    unit = is_angle(varied.kind) ? out.scene.angle_to_rad : out.scene.length_to_mm;
  }
  std::string values;
  for (const double value : sweep.values) values += Writer::number(value / unit) + ", ";
  out.line("values", "[" + values + "]");
  if (sweep.arc_length) out.word("path", "arc length");
}

}  // namespace

std::string scene_text(const Scene& scene) {
  Writer out{scene, {}};
  out.word("title", scene.title);
  out.table("[units]");
  out.word("length", unit_name(scene.length_to_mm));
  out.word("angle", scene.angle_to_rad == 1 ? "rad" : "deg");
  out.word("force", "N");
  for (const BodyDescription& body : scene.bodies) write(out, body);
  if (scene.joint) {
    out.table("[joint]");
    out.word("side", scene.joint->side == Side::kLeft ? "left" : "right");
    write(out, "femur", scene.joint->femur);
    write(out, "tibia", scene.joint->tibia);
  }
  for (const SurfaceDescription& surface : scene.surfaces) write(out, surface);
  for (const ContactDescription& contact : scene.contacts) write(out, contact);
  for (const WrapDescription& wrap : scene.wraps) write(out, wrap);
  for (const LigamentDescription& ligament : scene.ligaments) write(out, ligament);
  for (const ConditionDescription& condition : scene.conditions) write(out, condition);
  for (const LoadDescription& load : scene.loads) write(out, load);
  if (scene.sweep) write(out, *scene.sweep);
  return std::move(out.text);
}

}  // namespace condyle::random_knees
