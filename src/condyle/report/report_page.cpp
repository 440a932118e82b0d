#include "condyle/report/report_page.h"

#include <fmt/format.h>

#include <functional>
#include <vector>

#include "condyle/report/html.h"
#include "condyle/report/sections.h"

namespace condyle {
namespace {

/// "25 poses, flexion from 0 to 120 deg"
std::string what_was_done(const Run& run) {
  const std::vector<PoseResult>& poses = run.sweep.poses;
  if (run.kind() == RunKind::kLaxity) return "Test of laxity";
  if (run.kind() == RunKind::kCalibration) return "Calibration";
  if (poses.empty()) return "Fit of the surfaces";
  const SweptQuantity swept = swept_quantity(run);
  return fmt::format("{}{} poses, {} from {} to {}{}",
                     run.comparison() ? "Comparison with Wismans' model, " : "", poses.size(),
                     swept.name, at_value(swept, poses.front().value),
                     at_value(swept, poses.back().value), swept.unit_after_number());
}

}  // namespace

std::string report_page(const Run& run, const std::string& file, const ReportOptions& options) {
  std::vector<std::function<std::string()>> parts = {
      [&] {
        return page_head(run.scene.title.empty() ? "A knee" : run.scene.title, what_was_done(run));
      },
      [&] { return status_section(run); }};
  parts.emplace_back([&] { return calibration_section(run); });
  if (options.viewer) parts.emplace_back([&] { return viewer_section(run, file); });
  if (options.pictures) {
    parts.emplace_back([&] { return picture_section(run); });
    parts.emplace_back([&] { return plot_section(run); });
  } else {
    parts.emplace_back(
        [] { return section("pictures", "Pictures", "<p>Left out on request.</p>\n"); });
  }
  parts.emplace_back(
      [&] { return comparison_section(run) + laxity_section(run) + motion_section(run); });
  parts.emplace_back([&] { return pose_section(run) + event_section(run); });
  parts.emplace_back(
      [&] { return contact_section(run) + layer_section(run) + ligament_section(run); });
  parts.emplace_back([&] { return sensitivity_section(run, options.pictures); });
  parts.emplace_back([&] { return solver_section(run) + fit_section(run); });
  parts.emplace_back([&] { return source_section(run, file); });
  return page_of(parts, options.on_part);
}

}  // namespace condyle
