#include <cmath>

#include "random/scene_writer.h"

namespace condyle::random_knees {
namespace {

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

}  // namespace

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

}  // namespace condyle::random_knees
