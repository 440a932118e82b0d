#include "pictures/plot_run.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "pictures/ligament_groups.h"
#include "pictures/plot_comparison.h"
#include "pictures/swept_quantity.h"

namespace condyle {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

/// y of each converged pose over the swept value.
Curve curve_of(const Run& run,
               const std::string& title,
               const std::function<double(const PoseResult&)>& y) {
  const SweptQuantity swept = swept_quantity(run.scene);
  Curve curve{title, {}, {}};
  for (const PoseResult& pose : run.sweep.poses) {
    curve.x.push_back(swept.shown(pose.value));
    curve.y.push_back(pose.converged() ? y(pose) : std::numeric_limits<double>::quiet_NaN());
  }
  return curve;
}

Chart chart_of(const Run& run, const std::string& what) {
  const SweptQuantity swept = swept_quantity(run.scene);
  const std::string unit = swept.unit == "×" || swept.unit.empty() ? "" : " [" + swept.unit + "]";
  return {(run.scene.title.empty() ? "" : run.scene.title + ": ") + what, swept.title + unit, {}};
}

double total_force(const PoseResult& pose, const std::vector<std::size_t>& strands) {
  double sum = 0;
  for (const std::size_t i : strands)
    sum += i < pose.ligaments.size() ? pose.ligaments[i].force : 0;
  return sum;
}

}  // namespace

Chart joint_coordinate_chart(const Run& run) {
  Chart chart = chart_of(run, "joint coordinates");
  if (!run.scene.joint) return chart;
  Panel angles{"Rotation [°]", {}}, lengths{"Translation [mm]", {}};
  const auto angle = [&](const std::string& title, double JointCoordinates::*member) {
    angles.curves.push_back(curve_of(
        run, title, [member](const PoseResult& pose) { return kDegrees * (pose.joint.*member); }));
  };
  const auto length = [&](const std::string& title, double JointCoordinates::*member) {
    lengths.curves.push_back(
        curve_of(run, title, [member](const PoseResult& pose) { return pose.joint.*member; }));
  };
  if (!swept_quantity(run.scene).flexion) angle("flexion", &JointCoordinates::flexion);
  angle("adduction", &JointCoordinates::adduction);
  angle("internal rotation", &JointCoordinates::internal_rotation);
  length("lateral shift", &JointCoordinates::lateral_shift);
  length("anterior drawer", &JointCoordinates::anterior_drawer);
  length("distraction", &JointCoordinates::distraction);
  chart.panels = {angles, lengths};
  return chart;
}

Chart contact_force_chart(const Run& run) {
  Chart chart = chart_of(run, "contact forces");
  Panel panel{"Contact force [N]", {}, true};
  for (std::size_t c = 0; c < run.scene.contacts.size(); ++c) {
    panel.curves.push_back(curve_of(run, run.scene.contacts[c].name, [c](const PoseResult& pose) {
      return c < pose.contacts.size() ? pose.contacts[c].force
                                      : std::numeric_limits<double>::quiet_NaN();
    }));
  }
  if (!panel.curves.empty()) chart.panels = {panel};
  return chart;
}

Chart ligament_force_chart(const Run& run) {
  Chart chart = chart_of(run, "ligament forces");
  Panel panel{"Ligament force [N]", {}, true};
  for (const LigamentBundle& group : ligament_groups(run.scene)) {
    panel.curves.push_back(curve_of(
        run, group.name, [&](const PoseResult& pose) { return total_force(pose, group.members); }));
  }
  if (!panel.curves.empty()) chart.panels = {panel};
  return chart;
}

std::vector<std::filesystem::path> plot_run(const Run& run,
                                            const std::filesystem::path& folder,
                                            const std::vector<PlotFormat>& formats) {
  std::vector<NamedChart> charts = {{"joint_coordinates", joint_coordinate_chart(run)},
                                    {"contact_forces", contact_force_chart(run)},
                                    {"ligament_forces", ligament_force_chart(run)}};
  if (run.sweep.poses.empty()) charts.clear();
  for (NamedChart& chart : comparison_charts(run)) charts.push_back(std::move(chart));
  if (run.laxity) charts.push_back({"laxity", laxity_chart(run)});
  std::vector<std::filesystem::path> written;
  for (const auto& [name, chart] : charts) {
    for (const PlotFormat format : formats) {
      if (chart.panels.empty()) continue;
      written.push_back(folder / (name + (format == PlotFormat::kPng ? ".png" : ".svg")));
      plot(chart, written.back(), format);
    }
  }
  return written;
}

}  // namespace condyle
