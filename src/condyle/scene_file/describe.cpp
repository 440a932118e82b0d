#include "condyle/scene_file/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "condyle/math/degree.h"
#include "condyle/scene/ligament_number.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene/swept_quantity.h"

namespace condyle {
namespace {

using Out = std::back_insert_iterator<std::string>;

const char* word(SurfaceKind kind) {
  switch (kind) {
    case SurfaceKind::kPatch:
      return "patch";
    case SurfaceKind::kPlane:
      return "plane";
    case SurfaceKind::kSphere:
      return "sphere";
    case SurfaceKind::kCylinder:
      return "cylinder";
    case SurfaceKind::kEllipsoid:
      return "ellipsoid";
    case SurfaceKind::kTorus:
      return "torus";
    case SurfaceKind::kPolynomial:
      return "polynomial";
  }
  return "";
}

const char* word(ConditionKind kind) {
  switch (kind) {
    case ConditionKind::kFlexion:
      return "flexion";
    case ConditionKind::kAdduction:
      return "adduction";
    case ConditionKind::kInternalRotation:
      return "internal rotation";
    case ConditionKind::kLateralShift:
      return "lateral shift";
    case ConditionKind::kAnteriorDrawer:
      return "anterior drawer";
    case ConditionKind::kDistraction:
      return "distraction";
    case ConditionKind::kTranslation:
      return "translation";
    case ConditionKind::kRotation:
      return "rotation";
    case ConditionKind::kDistance:
      return "distance";
  }
  return "";
}

const char* word(ContactState state) {
  return state == ContactState::kAuto     ? "opens and closes"
         : state == ContactState::kClosed ? "closed"
                                          : "open";
}

const char* word(const ContactDescription& contact) {
  if (!contact.layer) return word(contact.state);
  return contact.layer->pressure == PressureLaw::kLinear ? "elastic layers, linear"
                                                         : "elastic layers, logarithmic";
}

const char* word(const ForceLaw& law) {
  constexpr std::array<const char*, 5> kWords = {"toe-linear", "quadratic", "polynomial", "table",
                                                 "custom"};
  return kWords[law.index()];
}

const std::string& body_name(const Scene& scene, int body) {
  return scene.bodies[static_cast<std::size_t>(body)].name;
}

std::string source_of(const Scene& scene, const SurfaceDescription& surface) {
  if (surface.kind != SurfaceKind::kPatch) return surface.solid_inside ? "" : ", solid outside";
  const PatchDescription& patch = surface.patch;
  const std::string part = !patch.compartment                           ? "region"
                           : *patch.compartment == Compartment::kMedial ? "medial compartment"
                                                                        : "lateral compartment";
  const MeshFile& mesh = *scene.mesh_of(surface);
  return fmt::format(", {} of {}{}", part, mesh.path.filename().string(),
                     patch.offset > 0 ? fmt::format(", moved {:g} mm out", patch.offset) : "");
}

std::string elastic_of(const SurfaceDescription& surface) {
  if (!surface.elastic) return "";
  const ElasticSurface& elastic = *surface.elastic;
  return fmt::format(", E = {:g} N/mm^2, nu = {:g}{}", elastic.modulus, elastic.poisson,
                     elastic.layer > 0 ? fmt::format(", layer of {:g} mm", elastic.layer) : "");
}

void describe_bodies(const Scene& scene, Out out) {
  for (const BodyDescription& body : scene.bodies) {
    fmt::format_to(out, "body       {}: {}{}\n", body.name, body.fixed ? "fixed" : "moving",
                   body.mesh ? ", mesh " + body.mesh->path.filename().string() : "");
  }
  if (scene.joint) {
    fmt::format_to(out, "joint      {} knee, femur \"{}\", tibia \"{}\"\n",
                   scene.joint->side == Side::kRight ? "right" : "left",
                   body_name(scene, scene.joint->femur.body),
                   body_name(scene, scene.joint->tibia.body));
  }
}

void describe_contacts(const Scene& scene, Out out) {
  for (const SurfaceDescription& surface : scene.surfaces) {
    fmt::format_to(out, "surface    {}: {} on {}{}{}\n", surface.name, word(surface.kind),
                   body_name(scene, surface.body), source_of(scene, surface), elastic_of(surface));
  }
  for (const ContactDescription& contact : scene.contacts) {
    const auto name = [&](int i) { return scene.surfaces[static_cast<std::size_t>(i)].name; };
    fmt::format_to(out, "contact    {}: {} with {}, {}\n", contact.name, name(contact.surfaces[0]),
                   name(contact.surfaces[1]), word(contact));
  }
}

std::string in_words(const WrapShape& shape) {
  struct Words {
    std::string operator()(const WrapSphere& s) const {
      return fmt::format("sphere, radius {:.6g} mm", s.radius);
    }
    std::string operator()(const WrapCylinder& s) const {
      return fmt::format("cylinder, radius {:.6g} mm", s.radius);
    }
    std::string operator()(const WrapEllipsoid& s) const {
      return fmt::format("ellipsoid, semi-axes {:.6g}, {:.6g}, {:.6g} mm", s.semi_axes.x(),
                         s.semi_axes.y(), s.semi_axes.z());
    }
    std::string operator()(const WrapTorus& s) const {
      return fmt::format("torus, radii {:.6g} and {:.6g} mm", s.ring, s.tube);
    }
  };
  return std::visit(Words{}, shape);
}

void describe_wraps(const Scene& scene, Out out) {
  for (const WrapDescription& wrap : scene.wraps)
    fmt::format_to(
        out, "wrap       {}: {} on {}\n", wrap.name,
        wrap.fit && !wrap.fit->done ? "ellipsoid, fitted to the bone" : in_words(wrap.shape),
        body_name(scene, wrap.body));
}

/// ", over the medial rim, 2 mm thick"
std::string path_of(const Scene& scene, const LigamentDescription& ligament) {
  std::string words;
  for (const int wrap : ligament.path.wraps)
    words += fmt::format("{}{}", words.empty() ? ", over " : " and ",
                         scene.wraps[static_cast<std::size_t>(wrap)].name);
  if (ligament.path.thickness > 0) words += fmt::format(", {:g} mm thick", ligament.path.thickness);
  return words;
}

void describe_ligaments(const Scene& scene, Out out) {
  const RigidTransform X_BA = start_pose(scene);
  for (const LigamentDescription& ligament : scene.ligaments) {
    if (!has_known_path(scene, ligament)) {
      fmt::format_to(out, "ligament   {}: {}{}\n", ligament.name, word(ligament.law),
                     path_of(scene, ligament));
      continue;
    }
    const double length = ligament_length(scene, ligament, X_BA);
    const double slack = slack_length(ligament.law);
    fmt::format_to(out, "ligament   {}: {}{}, {:.4g} mm at the start pose", ligament.name,
                   word(ligament.law), path_of(scene, ligament), length);
    if (slack > 0) {
      const double strain = std::round(1000 * (length / slack - 1)) / 10 + 0.0;  // never "-0.0"
      fmt::format_to(out, ", slack length {:.4g} mm, strain {:+.1f} %", slack, strain);
    }
    fmt::format_to(out, ", {:.4g} N\n", tension(ligament.law, length).force);
  }
}

void describe_motion(const Scene& scene, Out out) {
  for (const ConditionDescription& condition : scene.conditions) {
    const bool angle = is_angle(condition.kind);
    fmt::format_to(out, "condition  {}: {} = {:.6g} {}\n", condition.name, word(condition.kind),
                   condition.value / (angle ? kDegree : 1), angle ? "deg" : "mm");
  }
  for (const LoadDescription& load : scene.loads) {
    fmt::format_to(out, "load       {}: {} on {}, ({:.6g}, {:.6g}, {:.6g}) {}, {}{}\n", load.name,
                   load.moment ? "moment" : "force", body_name(scene, load.body), load.vector.x(),
                   load.vector.y(), load.vector.z(), load.moment ? "N mm" : "N",
                   load.follows_body ? "follows the body" : "keeps its direction",
                   load.scale == 1 ? "" : fmt::format(", {:.6g} times", load.scale));
  }
  if (scene.sweep) {
    const SweptQuantity swept = quantity_of_sweep(scene);
    const std::vector<double>& values = scene.sweep->values;
    fmt::format_to(out, "sweep      {} from {:.6g} to {:.6g} {}, {} poses\n", swept.name,
                   swept.shown(values.front()), swept.shown(values.back()), swept.unit.name,
                   values.size());
  }
  if (scene.simulation) {
    const SimulationDescription& simulation = *scene.simulation;
    fmt::format_to(out, "simulate   {:.6g} s, {:.6g} frames per second, restitution {:.3g}\n",
                   simulation.time, simulation.rate, simulation.restitution);
  }
  if (!scene.laxity) return;
  fmt::format_to(out, "laxity     at");
  for (const double flexion : scene.laxity->flexions)
    fmt::format_to(out, " {:.6g}", flexion / kDegree);
  fmt::format_to(out, " deg of flexion");
  for (const int cut : scene.laxity->cut) {
    fmt::format_to(out, "{} {}", cut == scene.laxity->cut.front() ? ", also without" : ",",
                   scene.ligaments[cut].name);
  }
  fmt::format_to(out, "\n");
}

/// "reference strain"; of a load its size.
std::string words(ParameterKind what) {
  if (what == ParameterKind::kLoadScale) return "size";
  std::string words = word_of(what);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

void describe_calibration(const Scene& scene, Out out) {
  if (!scene.calibration) return;
  fmt::format_to(out, "calibrate  to {}\n", scene.calibration->measurements.filename().string());
  for (const CalibrationParameter& parameter : scene.calibration->parameters) {
    const bool load = parameter.what == ParameterKind::kLoadScale;
    fmt::format_to(out, "free       {} of {} {}{}{}, prior within {:.4g}\n", words(parameter.what),
                   parameter.of.size(), load ? "loads" : "ligaments",
                   parameter.body < 0 ? "" : " on " + body_name(scene, parameter.body),
                   parameter.together ? ", together" : "", parameter.prior_sd);
  }
}

}  // namespace

std::string describe(const Scene& scene) {
  std::string text = scene.title + "\n";
  const Out out(text);
  describe_bodies(scene, out);
  describe_contacts(scene, out);
  describe_wraps(scene, out);
  describe_ligaments(scene, out);
  describe_motion(scene, out);
  describe_calibration(scene, out);
  return text;
}

}  // namespace condyle
