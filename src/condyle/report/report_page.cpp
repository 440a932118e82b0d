#include "condyle/report/report_page.h"

#include <fmt/format.h>

#include <functional>
#include <vector>

#include "condyle/report/embedded.h"
#include "condyle/report/html.h"
#include "condyle/report/sections.h"

namespace condyle {
namespace {

// Nothing is fetched from anywhere, whatever stands in the page.
constexpr const char* kPolicy =
    "default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; script-src "
    "'unsafe-inline'";

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

std::string head(const Run& run) {
  const std::string title = run.scene.title.empty() ? "A knee" : run.scene.title;
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n"
      "<title>{} - condyle</title>\n<style>\n{}</style>\n</head>\n<body>\n"
      "<header>\n<h1>{}</h1>\n<p>{}</p>\n</header>\n<main>\n",
      kPolicy, escaped(title), page_style(), escaped(title), escaped(what_was_done(run)));
}

}  // namespace

std::string report_page(const Run& run, const std::string& file, const ReportOptions& options) {
  using Part = std::function<std::string()>;
  std::vector<Part> parts = {[&] { return head(run); }, [&] { return status_section(run); }};
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
  std::string page;
  int done = 0;
  for (const Part& part : parts) {
    page += part();
    if (options.on_part) options.on_part(++done, static_cast<int>(parts.size()));
  }
  return page + "</main>\n</body>\n</html>\n";
}

}  // namespace condyle
