#include <cmath>

#include "random/scene_writer.h"

namespace condyle::random_knees {
namespace {

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

}  // namespace

void write(Writer& out, const WrapDescription& wrap) {
  out.table("[[wrap]]");
  out.word("name", wrap.name);
  out.line("body", out.body(wrap.body));
  std::visit(WriteWrap{out, wrap}, wrap.shape);
}

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

}  // namespace condyle::random_knees
