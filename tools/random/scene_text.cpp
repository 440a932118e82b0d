#include "random/scene_text.h"

#include <fmt/format.h>

#include <cmath>

#include "condyle/scene_file/scene_words.h"

namespace condyle::random_knees {
namespace {

/// Numbers of a file that has units.
struct Writer {
  const Scene& scene;
  std::string text;

  [[nodiscard]] static std::string number(double x) { return fmt::format("{:.17g}", x); }
  [[nodiscard]] static std::string vector(const Eigen::Vector3d& v) {
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
  }
  [[nodiscard]] std::string length(double mm) const { return number(mm / scene.length_to_mm); }
  [[nodiscard]] std::string place(const Eigen::Vector3d& mm) const {
    return vector(mm / scene.length_to_mm);
  }
  [[nodiscard]] static std::string axes(const Eigen::Matrix3d& R) {
    return fmt::format("[{}, {}, {}]", vector(R.col(0)), vector(R.col(1)), vector(R.col(2)));
  }
  [[nodiscard]] std::string body(int index) const {
    return "\"" + scene.bodies[static_cast<std::size_t>(index)].name + "\"";
  }
  [[nodiscard]] std::string end(const Attachment& at) const {
    return fmt::format("{{ body = {}, at = {} }}", body(at.body), place(at.at));
  }
  void line(const std::string& key, const std::string& value) {
    text += key + " = " + value + "\n";
  }
  void word(const std::string& key, const std::string& value) { line(key, "\"" + value + "\""); }
  void table(const std::string& name) { text += "\n" + name + "\n"; }
};

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

void write_shape(Writer& out, const SurfaceDescription& surface) {
  switch (surface.kind) {
    case SurfaceKind::kPatch:
      out.word("kind", "patch");
      out.word("mesh", surface.name + ".stl");
      return out.line("region",
                      fmt::format("{{ box = [{}, {}] }}", out.place((*surface.patch.region_box)[0]),
                                  out.place((*surface.patch.region_box)[1])));
    case SurfaceKind::kPlane:
      out.word("kind", "plane");
      out.line("point", out.place(surface.point));
      out.line("normal", Writer::vector(surface.direction));
      break;
    case SurfaceKind::kSphere:
      out.word("kind", "sphere");
      out.line("center", out.place(surface.point));
      out.line("radius", out.length(surface.radius));
      break;
    case SurfaceKind::kCylinder:
      out.word("kind", "cylinder");
      out.line("point", out.place(surface.point));
      out.line("axis", Writer::vector(surface.direction));
      out.line("radius", out.length(surface.radius));
      if (std::isfinite(surface.length)) out.line("length", out.length(surface.length));
      break;
    case SurfaceKind::kEllipsoid:
      out.word("kind", "ellipsoid");
      out.line("center", out.place(surface.point));
      out.line("semi_axes", out.place(surface.semi_axes));
      out.line("axes", Writer::axes(surface.axes));
      break;
    case SurfaceKind::kTorus:
      out.word("kind", "torus");
      out.line("center", out.place(surface.point));
      out.line("axis", Writer::vector(surface.direction));
      out.line("major", out.length(surface.radius));
      out.line("minor", out.length(surface.minor_radius));
      break;
    case SurfaceKind::kPolynomial: {
      out.word("kind", "polynomial");
      out.line("frame", fmt::format("{{ origin = {}, axes = {} }}", out.place(surface.point),
                                    Writer::axes(surface.axes)));
      std::string terms;
      for (const PolynomialTerm& term : surface.terms)
        terms += fmt::format("[{}, {}, {:.17g}], ", term.i, term.j,
                             term.a * std::pow(out.scene.length_to_mm, term.i + term.j - 1));
      out.line("coefficients", "[" + terms + "]");
      break;
    }
  }
  if (std::isfinite(surface.known_radius)) out.line("radius", out.length(surface.known_radius));
  if (surface.kind != SurfaceKind::kPlane)
    out.word("solid", surface.solid_inside ? "inside" : "outside");
}

void write(Writer& out, const SurfaceDescription& surface) {
  out.table("[[surface]]");
  out.word("name", surface.name);
  out.line("body", out.body(surface.body));
  write_shape(out, surface);
  if (!surface.elastic) return;
  const double unit = out.scene.length_to_mm;
  out.line("modulus",
           Writer::number(surface.elastic->modulus * unit * unit / out.scene.force_to_n));
  out.line("poisson", Writer::number(surface.elastic->poisson));
  out.line("layer", out.length(surface.elastic->layer));
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

struct WriteWrap {
  Writer& out;
  const WrapDescription& wrap;
  void operator()(const WrapSphere& sphere) const {
    out.word("kind", "sphere");
    out.line("center", out.place(wrap.placement.p));
    out.line("radius", out.length(sphere.radius));
  }
  void operator()(const WrapCylinder& cylinder) const {
    out.word("kind", "cylinder");
    out.line("point", out.place(wrap.placement.p));
    out.line("axis", Writer::vector(wrap.placement.R.col(2)));
    out.line("radius", out.length(cylinder.radius));
  }
  void operator()(const WrapEllipsoid& ellipsoid) const {
    out.word("kind", "ellipsoid");
    out.line("center", out.place(wrap.placement.p));
    out.line("axes", Writer::axes(wrap.placement.R));
    out.line("semi_axes", out.place(ellipsoid.semi_axes));
  }
  void operator()(const WrapTorus& torus) const {
    out.word("kind", "torus");
    out.line("center", out.place(wrap.placement.p));
    out.line("axis", Writer::vector(wrap.placement.R.col(2)));
    out.line("major", out.length(torus.ring));
    out.line("minor", out.length(torus.tube));
  }
};

struct WriteLaw {
  Writer& out;
  const std::optional<double>& strain;
  void slack(double length) const {
    if (strain) return out.line("reference_strain", Writer::number(*strain));
    out.line("slack_length", out.length(length));
  }
  void operator()(const ToeLinearLaw& law) const {
    out.word("law", "toe-linear");
    out.line("stiffness", Writer::number(law.stiffness / out.scene.force_to_n));
    out.line("transition_strain", Writer::number(law.transition_strain));
    slack(law.slack_length);
  }
  void operator()(const QuadraticLaw& law) const {
    out.word("law", "quadratic");
    const double unit = out.scene.length_to_mm;
    out.line("stiffness", Writer::number(law.stiffness * unit * unit / out.scene.force_to_n));
    slack(law.slack_length);
  }
  void operator()(const PolynomialLaw& law) const {
    out.word("law", "polynomial");
    std::string list;
    for (std::size_t i = 0; i < law.coefficients.size(); ++i)
      list += Writer::number(law.coefficients[i] *
                             std::pow(out.scene.length_to_mm, static_cast<double>(i)) /
                             out.scene.force_to_n) +
              ", ";
    out.line("coefficients", "[" + list + "]");
    out.line("tension_only", law.tension_only ? "true" : "false");
  }
  void operator()(const TableLaw& law) const {
    out.word("law", "table");
    std::string lengths, forces;
    for (const double length : law.lengths) lengths += out.length(length) + ", ";
    for (const double force : law.forces)
      forces += Writer::number(force / out.scene.force_to_n) + ", ";
    out.line("lengths", "[" + lengths + "]");
    out.line("forces", "[" + forces + "]");
  }
  void operator()(const CustomLaw&) const {}
};

void write(Writer& out, const LigamentDescription& ligament) {
  out.table("[[ligament]]");
  out.word("name", ligament.name);
  out.line("ends", fmt::format("[{}, {}]", out.end(ligament.ends[0]), out.end(ligament.ends[1])));
  std::visit(WriteLaw{out, ligament.reference_strain}, ligament.law);
  if (ligament.path.wraps.empty()) return;
  std::string names;
  for (const int wrap : ligament.path.wraps)
    names += "\"" + out.scene.wraps[static_cast<std::size_t>(wrap)].name + "\", ";
  out.line("wraps", "[" + names + "]");
  if (ligament.path.thickness > 0) out.line("thickness", out.length(ligament.path.thickness));
  if (!ligament.path.anchors_inside) out.word("inside", "straight");
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
  for (const WrapDescription& wrap : scene.wraps) {
    out.table("[[wrap]]");
    out.word("name", wrap.name);
    out.line("body", out.body(wrap.body));
    std::visit(WriteWrap{out, wrap}, wrap.shape);
  }
  for (const LigamentDescription& ligament : scene.ligaments) write(out, ligament);
  for (const ConditionDescription& condition : scene.conditions) write(out, condition);
  for (const LoadDescription& load : scene.loads) write(out, load);
  if (scene.sweep) write(out, *scene.sweep);
  return std::move(out.text);
}

}  // namespace condyle::random_knees
