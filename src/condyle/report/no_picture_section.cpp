#include "condyle/report/compared_runs_page.h"
#include "condyle/report/html.h"
#include "condyle/report/sections.h"
#include "condyle/report/study_page.h"
#include "condyle/report/viewer_pressures.h"

namespace condyle {

std::string picture_section(const Run& run) {
  if (run.sweep.poses.empty()) return "";
  return section("pictures", "Pictures",
                 "<p>This condyle was built without pictures and plots.</p>\n");
}

std::string plot_section(const Run&) { return ""; }

std::string study_plot_section(const StudyView&) {
  return section("plots", "Plots", "<p>This condyle was built without plots.</p>\n");
}

std::string sensitivity_figure(const Run&) { return ""; }

ViewerPressures viewer_pressures(const Run&, const ShapeOptions&, const std::vector<ShownPose>&) {
  return {};
}

std::string compared_picture_section(const RunComparison&) { return ""; }

}  // namespace condyle
