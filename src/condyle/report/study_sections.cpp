#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/compare/laxity.h"
#include "condyle/report/html.h"
#include "condyle/report/sections.h"
#include "condyle/results/motion_view.h"
#include "condyle/results/run_layout.h"

namespace condyle {
namespace {

std::string pair_of(const std::array<double, 2>& values, const char* format) {
  return fmt::format(fmt::runtime(format), values[0], values[1]);
}

std::string yes_of(const LaxityCurve& curve) {
  return fmt::format("{} of {}", curve.ours.count_converged(), curve.ours.poses.size());
}

}  // namespace

std::string comparison_section(const Run& run) {
  if (!run.comparison()) return "";
  const Comparison& comparison = *run.comparison();
  HtmlTable table{"Ours and Wismans' model of the same specimen, over the sweep",
                  {"quantity", "units", "rms difference", "largest difference"},
                  {},
                  {0, 1}};
  for (const ComparedQuantity& quantity : comparison.quantities) {
    const Difference d = difference(quantity.of(Variant::kOurs), quantity.of(Variant::kReference));
    table.rows.push_back({quantity.name, quantity.units, d.count > 0 ? short_number(d.rms) : "-",
                          d.count > 0 ? short_number(d.max) : "-"});
  }
  const std::string lead = fmt::format(
      "<p>Wismans' model converged at {} of {} poses; polynomials of degree {}. A pose takes ours "
      "{} µs and {} iterations, Wismans' model {} µs and {}.</p>\n",
      comparison.reference.count_converged(), comparison.reference.poses.size(),
      comparison.options.degree, short_number(1e6 * comparison.seconds_ours),
      short_number(comparison.iterations_ours), short_number(1e6 * comparison.seconds_reference),
      short_number(comparison.iterations_reference));
  return section("comparison", "Comparison", lead + html(table));
}

std::string laxity_section(const Run& run) {
  if (!run.laxity() || !run.scene.joint) return "";
  const std::size_t k = loaded_coordinate(run.scene);
  std::string name = kJointColumns[k].name;
  std::replace(name.begin(), name.end(), '_', ' ');
  HtmlTable table{fmt::format("Change of {} [{}] from the first to the last load ({})", name,
                              kJointColumns[k].units, swept_quantity(run).name),
                  {"knee", "flexion [deg]", "laxity", "Wismans' model", "poses converged"},
                  {}};
  for (const LaxityCurve& curve : run.laxity()->curves) {
    table.rows.push_back(
        {curve.cut ? "cut" : "intact", fmt::format("{:.6g}", curve.flexion / kDegree),
         number(laxity_of(run.scene, curve.ours), 2),
         curve.reference ? number(laxity_of(run.scene, *curve.reference), 2) : "-", yes_of(curve)});
  }
  return section("laxity", "Laxity", html(table));
}

std::string motion_section(const Run& run) {
  const std::optional<MotionView> motion = motion_view(run);
  if (!motion || motion->energies.empty()) return "";
  constexpr double kJoule = 1e3;  // N mm
  HtmlTable energies{"Energy", {"", "change [J]"}, {}};
  const auto add = [&](const char* what, double MotionEnergies::*part) {
    energies.rows.push_back({what, fmt::format("{:+.4g}", motion->change(part) / kJoule)});
  };
  add("kinetic", &MotionEnergies::kinetic);
  add("gravity", &MotionEnergies::gravity);
  add("ligaments", &MotionEnergies::elastic);
  if (motion->layered) add("layers", &MotionEnergies::layers);
  add("dissipated", &MotionEnergies::dissipated);
  add("work of the loads", &MotionEnergies::work);
  HtmlTable events{"Contacts", {"time [s]", "contact", "event", "speed [mm/s]"}, {}, {1, 2}};
  for (const MotionEvent& event : motion->events) {
    events.rows.push_back({number(event.time, 5), event.contact, event.closing ? "closes" : "opens",
                           event.closing ? short_number(event.speed) : "-"});
  }
  const std::string verdict =
      motion->completed ? "" : "<p>Stopped " + escaped(motion->reason) + "</p>\n";
  return section("motion", "Motion",
                 verdict + html(energies) + (events.rows.empty() ? "" : html(events)));
}

std::string fit_section(const Run& run) {
  if (run.patches.empty()) return "";
  HtmlTable table{"Patches fitted to the meshes; distances from the mesh to the patch",
                  {"patch", "body", "control points", "rms [mm]", "95 % [mm]", "max [mm]",
                   "normals [deg]", "principal curvatures [1/mm]", "area [mm²]"},
                  {},
                  {0, 1}};
  std::string notes;
  for (const RunPatch& patch : run.patches) {
    const FitReport& fit = patch.report;
    const std::string body =
        patch.body < 0 ? "-" : run.scene.bodies.at(static_cast<std::size_t>(patch.body)).name;
    table.rows.push_back({patch.surface, body,
                          fmt::format("{} x {}", fit.control_points[0], fit.control_points[1]),
                          number(fit.rms, 3), number(fit.p95, 3), number(fit.max, 3),
                          number(fit.normal_rms / kDegree, 2),
                          pair_of(fit.curvature_range, "{:+.3f} to {:+.3f}"), number(fit.area, 0)});
    for (const std::string& note : fit.notes)
      notes += "<li>" + escaped(patch.surface + ": " + note) + "</li>\n";
  }
  if (!notes.empty()) notes = "<ul class=\"notes\">\n" + notes + "</ul>\n";
  return section("fit", "Fit of the surfaces", html(table) + notes);
}

std::string source_section(const Run& run, const std::string& file) {
  const auto item = [](const char* what, const std::string& text) {
    return text.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>\n", what, escaped(text));
  };
  std::string body = "<dl>\n" + item("Result file", file) + item("Written by", run.program) +
                     item("Written at (UTC)", run.created) +
                     item("Scene", run.scene.file.string()) + "</dl>\n";
  HtmlTable meshes{
      "Meshes, as they were when the run was computed", {"file", "SHA-256"}, {}, {0, 1}};
  for (const InputFile& input : run.inputs) meshes.rows.push_back({input.file, input.sha256});
  if (!meshes.rows.empty()) body += html(meshes);
  HtmlTable bodies{"", {"body", "vertices", "triangles"}, {}};
  for (const BodyMesh& mesh : run.bodies) {
    bodies.rows.push_back({mesh.name, fmt::format("{}", mesh.mesh.vertices.size()),
                           fmt::format("{}", mesh.mesh.triangles.size())});
  }
  if (!bodies.rows.empty()) body += html(bodies);
  body += details("The scene's text", "<pre>" + escaped(run.scene.text) + "</pre>\n");
  return section("source", "Computed from", body);
}

}  // namespace condyle
