#include "condyle/app/print_fit.h"

#include <fmt/format.h>

#include "condyle/app/tell.h"
#include "condyle/math/degree.h"
#include "condyle/report/summary_json.h"

namespace condyle {
namespace {

void print_head() {
  tell("from the mesh to the patch:\n");
  tell("{:<20}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>18}{:>7}\n", "patch", "points", "smooth", "rms",
       "95 %", "max", "core", "normals", "core curvature", "time");
  tell("{:<20}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>18}{:>7}\n", "", "", "mm", "mm", "mm", "mm",
       "rms mm", "deg", "1/mm", "s");
}

void print_row(const FitReport& report) {
  tell("{:<20}{:>9}{:>9.2f}{:>9.4f}{:>9.4f}{:>9.4f}{:>9.4f}{:>9.2f}{:>18}{:>7.2f}\n",
       report.surface, fmt::format("{}x{}", report.control_points[0], report.control_points[1]),
       report.smoothing_length, report.rms, report.p95, report.max, report.core_rms,
       report.normal_rms / kDegree,
       fmt::format("{:+.3f} to {:+.3f}", report.curvature_range[0], report.curvature_range[1]),
       report.seconds);
}

/// What of the patch can touch, and how far it lies from the mesh.
void print_known_part(const FitReport& report) {
  tell("{:<20}{:>18}{:>9.4f}{:>9.4f}{:>9.4f}{:>18}{:>18}{:>7.0f}{:>10.1e}\n", report.surface, "",
       report.back_rms, report.back_p95, report.back_max,
       fmt::format("{:.0f} x {:.0f}", report.extent[0], report.extent[1]),
       fmt::format("{:.0f} x {:.0f}", report.turn[0] / kDegree, report.turn[1] / kDegree),
       report.area, report.condition);
}

void print_known_head() {
  tell("\nfrom the patch, where it is known and can touch, to the mesh:\n");
  tell("{:<20}{:>18}{:>9}{:>9}{:>9}{:>18}{:>18}{:>7}{:>10}\n", "known part", "", "rms", "95 %",
       "max", "size", "turn", "area", "condition");
  tell("{:<20}{:>18}{:>9}{:>9}{:>9}{:>18}{:>18}{:>7}{:>10}\n", "", "", "mm", "mm", "mm", "mm",
       "deg", "mm^2", "");
}

}  // namespace

void print_fit(const std::vector<FittedSurface>& surfaces) {
  bool any = false;
  for (const FittedSurface& surface : surfaces) {
    if (!surface.report) continue;
    if (!any) print_head();
    any = true;
    print_row(*surface.report);
  }
  if (!any) return;
  for (const FittedSurface& surface : surfaces) {
    if (!surface.report) continue;
    for (const std::string& note : surface.report->notes)
      if (!is_warning(note)) tell("{}: {}\n", surface.report->surface, note);
  }
  tell("\n");
}

void print_known_parts(const std::vector<FittedSurface>& surfaces) {
  print_known_head();
  for (const FittedSurface& surface : surfaces)
    if (surface.report) print_known_part(*surface.report);
}

}  // namespace condyle
