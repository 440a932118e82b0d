#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/compare/laxity.h"
#include "condyle/input_error.h"
#include "condyle/math/no_number.h"
#include "condyle/report/html.h"
#include "condyle/report/sections.h"
#include "condyle/report/summary_json.h"
#include "condyle/results/run_layout.h"
#include "condyle/results/run_view.h"
#include "condyle/results/uncertainty_group.h"
#include "condyle/verify/verify.h"

namespace condyle {
namespace {

using Poses = std::vector<PoseResult>;

std::string list_of(const std::vector<std::string>& lines, const char* kind) {
  std::string out = fmt::format("<ul class=\"{}\">\n", kind);
  for (const std::string& line : lines) out += "<li>" + escaped(line) + "</li>\n";
  return out + "</ul>\n";
}

std::string verdict(int converged, std::size_t all) {
  const bool good = converged == static_cast<int>(all);
  return fmt::format("<p class=\"verdict {}\"><strong>{} of {}</strong> poses converged</p>\n",
                     good ? "good" : "bad", converged, all);
}

/// Failed poses, each with its reason.
std::string failed_poses(const Run& run, const SweptQuantity& swept) {
  HtmlTable table{"Poses that did not succeed", {swept.heading(), "status", "reason"}, {}, {1, 2}};
  for (const PoseResult& pose : run.sweep.poses) {
    if (!pose.converged())
      table.rows.push_back({at_value(swept, pose.value), name(pose.status), pose.reason});
  }
  if (table.rows.empty()) return "";
  return html(table) +
         "<p class=\"note\">What each status means and what to do: docs/questions.md, "
         "Why did this pose fail?</p>\n";
}

/// By the code of the room `verify`, at the moment the page is written.
std::string verified(const Run& run) {
  Verification verification;
  try {
    verification = verify_run(run);
  } catch (const InputError& error) {
    return fmt::format("<p class=\"verdict bad\">Not verified: {}</p>\n", escaped(error.what()));
  }
  std::string body =
      fmt::format("<p class=\"verdict {}\">Verified: {}</p>\n",
                  verification.verified() ? "good" : "bad", escaped(verdict(verification)));
  std::vector<std::string> lines;
  for (const Fault& fault : verification.faults) lines.push_back(fault.text);
  if (!lines.empty()) body += list_of(lines, "warnings");
  return body;
}

std::string laxity_verdict(const LaxityResult& laxity) {
  int converged = 0;
  std::size_t all = 0;
  for (const LaxityCurve& curve : laxity.curves) {
    converged += curve.ours.count_converged();
    all += curve.ours.poses.size();
  }
  return verdict(converged, all);
}

}  // namespace

std::string at_value(const SweptQuantity& swept, double value) {
  const double shown = swept.shown(value);
  return fmt::format("{:.6g}", std::abs(shown) < 1e-9 ? 0.0 : shown);
}

std::string status_section(const Run& run) {
  std::string body;
  if (!run.sweep.poses.empty()) {
    body += verdict(run.sweep.count_converged(), run.sweep.poses.size());
    body += failed_poses(run, swept_quantity(run));
    body += verified(run);
  }
  if (run.laxity()) body += laxity_verdict(*run.laxity());
  if (run.uncertainty)
    body += "<p>Given the meshes: " + escaped(uncertainty_words(*run.uncertainty)) + ".</p>\n";
  const std::vector<std::string> warnings = run_warnings(run);
  body += warnings.empty() ? "<p>No warnings.</p>\n" : list_of(warnings, "warnings");
  return section("status", "Status and warnings", body);
}

std::string pose_section(const Run& run) {
  const Poses& poses = run.sweep.poses;
  if (poses.empty()) return "";
  const SweptQuantity swept = swept_quantity(run);
  HtmlTable table;
  table.columns = {swept.heading()};
  const bool joint = run.scene.joint.has_value();
  if (joint) {
    for (std::size_t k = 0; k < kJointColumns.size(); ++k) {
      const auto& column = kJointColumns[k];
      if (is_swept(run, k)) continue;  // the first column says it
      std::string name = column.name;
      std::replace(name.begin(), name.end(), '_', ' ');
      table.columns.push_back(fmt::format("{} [{}]", name, column.units));
    }
  } else {
    for (const char* axis : {"x [mm]", "y [mm]", "z [mm]"}) table.columns.emplace_back(axis);
  }
  table.columns.emplace_back("stability");
  table.columns.emplace_back("status");
  const auto columns = static_cast<int>(table.columns.size());
  table.text_columns = {columns - 2, columns - 1};
  for (const PoseResult& pose : poses) {
    std::vector<std::string> row = {at_value(swept, pose.value)};
    for (std::size_t k = 0; k < (joint ? kJointColumns.size() : 3); ++k) {
      if (joint && is_swept(run, k)) continue;
      const double value = joint ? pose.joint.*kJointColumns[k].member / kJointColumns[k].unit
                                 : pose.X_BA.p[static_cast<Eigen::Index>(k)];
      row.push_back(number(has_place(pose) ? value : kNoNumber, 2));
    }
    row.emplace_back(pose.stability == 1 ? "stable" : pose.stability == 0 ? "not stable" : "-");
    row.push_back(name(pose.status) + (pose.reason.empty() ? "" : ": " + pose.reason));
    table.rows.push_back(std::move(row));
    table.row_classes.emplace_back(pose.converged() ? "" : "failed");
  }
  const char* what =
      joint ? "Joint coordinates at every pose" : "Place of the moving body at every pose";
  table.caption = what;
  return section("poses", "Poses", html(table));
}

std::string event_section(const Run& run) {
  if (run.sweep.poses.size() < 2 || run.kind() == RunKind::kSimulation) return "";
  if (run.sweep.events.empty())
    return section("events", "Events", "<p>No contact opened, closed or jumped.</p>\n");
  const SweptQuantity swept = swept_quantity(run);
  HtmlTable table{
      "",
      {swept.heading(), "event", run.scene.wraps.empty() ? "contact" : "contact or ligament"},
      {},
      {1, 2}};
  for (const Event& event : run.sweep.events) {
    const std::string subject = event_subject(run.scene, event);
    table.rows.push_back(
        {number(swept.shown(event.value), 4), name(event.kind), subject.empty() ? "-" : subject});
  }
  return section("events", "Events", html(table));
}

std::string solver_section(const Run& run) {
  const Poses& poses = run.sweep.poses;
  if (poses.empty() || run.kind() == RunKind::kSimulation) return "";
  const SweptQuantity swept = swept_quantity(run);
  HtmlTable table{
      "",
      {swept.heading(), "iterations", "residual [N]", "time [µs]", "lowest stiffness [N/mm]"},
      {},
      {}};
  int iterations = 0;
  double residual = 0, seconds = 0;
  for (const PoseResult& pose : poses) {
    iterations += pose.iterations;
    seconds += pose.seconds;
    if (pose.converged()) residual = std::max(residual, pose.residual);
    table.rows.push_back({at_value(swept, pose.value), fmt::format("{}", pose.iterations),
                          fmt::format("{:.1e}", pose.residual), number(1e6 * pose.seconds, 0),
                          short_number(pose.lowest_stiffness)});
  }
  const double n = static_cast<double>(poses.size());
  const std::string body = fmt::format(
      "<p>{:.3g} Newton iterations and {} a pose; largest out-of-balance force {:.1e} "
      "N.</p>\n",
      iterations / n, short_time(seconds / n, "µs"), residual);
  return section("solver", "Solver",
                 body + details("Each pose", html(table)) + trace_details(poses, swept));
}

}  // namespace condyle
