#include "app/print_fit.h"

#include <fmt/format.h>

#include <cmath>

namespace condyle {
namespace {

void print_head() {
  fmt::print("{:<20}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>18}{:>7}\n", "patch", "points", "smooth",
             "rms", "95 %", "max", "core", "normals", "core curvature", "time");
  fmt::print("{:<20}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}{:>18}{:>7}\n", "", "", "mm", "mm", "mm",
             "mm", "rms mm", "deg", "1/mm", "s");
}

void print_row(const FitReport& report) {
  constexpr double kDegree = M_PI / 180;
  fmt::print(
      "{:<20}{:>9}{:>9.2f}{:>9.4f}{:>9.4f}{:>9.4f}{:>9.4f}{:>9.2f}{:>18}{:>7.2f}\n", report.surface,
      fmt::format("{}x{}", report.control_points[0], report.control_points[1]),
      report.smoothing_length, report.rms, report.p95, report.max, report.core_rms,
      report.normal_rms / kDegree,
      fmt::format("{:+.3f} to {:+.3f}", report.curvature_range[0], report.curvature_range[1]),
      report.seconds);
}

}  // namespace

void print_fit(const std::vector<FittedSurface>& surfaces) {
  bool first = true;
  for (const FittedSurface& surface : surfaces) {
    if (!surface.report) continue;
    if (first) print_head();
    first = false;
    print_row(*surface.report);
  }
  for (const FittedSurface& surface : surfaces) {
    if (!surface.report) continue;
    for (const std::string& note : surface.report->notes)
      fmt::print("{}: {}\n", surface.report->surface, note);
  }
  if (!first) fmt::print("\n");
}

}  // namespace condyle
