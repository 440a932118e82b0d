#include "condyle/pictures/run_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <utility>

#include "condyle/elements/joint_table.h"
#include "condyle/math/no_number.h"
#include "condyle/pictures/ligament_groups.h"
#include "condyle/results/contact_path.h"
#include "condyle/results/motion_view.h"
#include "condyle/results/run_view.h"
#include "condyle/results/uncertainty_group.h"
#include "condyle/scene/ligament_path.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kLeastStrain = -10;  // [%]: how slack a slack ligament is says little

using OfPose = std::function<double(const PoseResult&)>;

/// y of each converged pose over the swept value; hollow where a pose has a place but is no result.
Curve curve_of(const Run& run, const std::string& title, const OfPose& y) {
  const double per_value = swept_quantity(run).axis_per_inside;
  Curve curve{title, {}, {}};
  for (const PoseResult& pose : run.sweep.poses) {
    const double x = per_value * pose.value;
    curve.x.push_back(x);
    curve.y.push_back(pose.converged() ? y(pose) : kNoNumber);
    if (pose.converged() || !has_place(pose)) continue;
    curve.hollow_x.push_back(x);
    curve.hollow_y.push_back(y(pose));
  }
  return curve;
}

/// The interval of 95 %, given the meshes, about a curve of curve_of; `place` under /sweep.
void add_band(const Run& run, const std::string& place, double unit, Curve& curve) {
  if (!run.uncertainty) return;
  const std::vector<double>* sd = inside_sd(*run.uncertainty, place);
  if (sd == nullptr) return;
  for (std::size_t i = 0; i < curve.y.size(); ++i) {
    const double half = interval_of(run.uncertainty->converged.at(i)) * unit * (*sd)[i];
    curve.low.push_back(curve.y[i] - half);
    curve.high.push_back(curve.y[i] + half);
  }
}

/// Where the chart has bands, its title says so.
std::string with_bands(const Run& run, const std::string& what) {
  return run.uncertainty ? what + " (bands: 95 %, given the meshes)" : what;
}

Chart chart_of(const Run& run, const std::string& what) {
  return {run.scene.title, what, swept_quantity(run).axis, {}};
}

bool has_value(const Curve& curve) {
  const auto known = [](double y) { return std::isfinite(y); };
  return std::any_of(curve.y.begin(), curve.y.end(), known) ||
         std::any_of(curve.hollow_y.begin(), curve.hollow_y.end(), known);
}

void keep(Chart& chart, Panel panel) {
  if (std::any_of(panel.curves.begin(), panel.curves.end(), has_value))
    chart.panels.push_back(std::move(panel));
}

double total_force(const PoseResult& pose, const std::vector<std::size_t>& strands) {
  double sum = 0;
  for (const std::size_t i : strands)
    sum += i < pose.ligaments.size() ? pose.ligaments[i].force : 0;
  return sum;
}

/// Of the strands that have a slack length.
double greatest_strain(const Scene& scene,
                       const PoseResult& pose,
                       const std::vector<std::size_t>& strands) {
  double greatest = kNoNumber;
  for (const std::size_t i : strands) {
    if (i >= pose.ligaments.size() || !has_strain(scene.ligaments[i].law)) continue;
    if (!(greatest >= pose.ligaments[i].strain)) greatest = pose.ligaments[i].strain;
  }
  return greatest;
}

/// On one surface, of the strands that may touch it [rad]; 0 off it.
double greatest_turn(const Scene& scene,
                     const PoseResult& pose,
                     const std::vector<std::size_t>& strands,
                     int wrap) {
  double greatest = kNoNumber;
  for (const std::size_t i : strands) {
    if (i >= pose.paths.size()) continue;
    const std::vector<LineTouch>& touches = pose.paths[i].touches;
    for (std::size_t k = 0; k < touches.size(); ++k)
      if (wrap_on_path(scene, scene.ligaments[i], static_cast<int>(k)) == wrap &&
          !(greatest >= touches[k].turn))
        greatest = touches[k].turn;
  }
  return greatest;
}

/// Mean of the points on the tibia, weighted by the size of their forces, as one that is held closed
/// may pull; nothing for an open contact.
std::optional<Vector3d> place_on_tibia(const Scene& scene,
                                       const PoseResult& pose,
                                       const ContactResult& contact) {
  if (!contact.closed) return std::nullopt;
  const bool moves = tibia_body(scene) == scene.moving_body();
  if (contact.layer) return acting_place(contact, pose.X_BA, moves);
  Vector3d sum = Vector3d::Zero();
  double forces = 0;
  for (const ContactPointResult& point : contact.points) {
    sum += std::abs(point.force) * (moves ? point.point_moving : point.point_ground);
    forces += std::abs(point.force);
  }
  return forces > 0 ? std::optional<Vector3d>(sum / forces) : std::nullopt;
}

Curve place_curve(const Run& run, std::size_t contact, const Vector3d& axis) {
  const OfPose along = [&](const PoseResult& pose) {
    if (contact >= pose.contacts.size()) return kNoNumber;
    const auto place = place_on_tibia(run.scene, pose, pose.contacts[contact]);
    return place ? axis.dot(*place - run.scene.joint->tibia.origin) : kNoNumber;
  };
  return broken_at_jumps(curve_of(run, run.scene.contacts[contact].name, along), run.sweep,
                         contact);
}

/// The balance is far smaller than its parts: in a unit that suits it.
Panel balance_panel(Curve curve) {
  double largest = 0;
  for (const double y : curve.y) largest = std::max(largest, std::abs(y));
  double per_joule = 1;
  const char* unit = "J";
  for (const auto& [factor, smaller] : {std::pair{1e3, "mJ"}, {1e6, "µJ"}, {1e9, "nJ"}}) {
    if (largest * per_joule >= 1 || largest == 0) break;
    per_joule = factor;
    unit = smaller;
  }
  for (double& y : curve.y) y *= per_joule;
  return {fmt::format("Balance [{}]", unit), {std::move(curve)}};
}

}  // namespace

Curve broken_at_jumps(Curve curve, const SweepResult& sweep, std::size_t contact) {
  const auto path = resultant_path(sweep, contact);
  for (std::size_t i = sweep.poses.size(); i-- > 1;) {
    if (!std::isfinite(curve.y[i - 1]) || !std::isfinite(curve.y[i]) || joined(path, i - 1, i))
      continue;
    const auto at = static_cast<std::ptrdiff_t>(i);
    curve.x.insert(curve.x.begin() + at, kNoNumber);
    curve.y.insert(curve.y.begin() + at, kNoNumber);
  }
  return curve;
}

Chart joint_coordinate_chart(const Run& run) {
  Chart chart = chart_of(run, with_bands(run, "joint coordinates"));
  if (!run.scene.joint) return chart;
  Panel angles{"Rotation [°]", {}}, lengths{"Translation [mm]", {}};
  const bool flexion_is_swept = swept_quantity(run).flexion;
  for (const JointCoordinate& q : kJointCoordinates) {
    if (flexion_is_swept && q.member == &JointCoordinates::flexion) continue;
    const double unit = q.angle ? kDegrees : 1;
    Curve curve =
        curve_of(run, q.words, [&](const PoseResult& p) { return unit * (p.joint.*q.member); });
    add_band(run, std::string("joint/") + q.name, unit, curve);
    (q.angle ? angles : lengths).curves.push_back(std::move(curve));
  }
  chart.panels = {angles, lengths};
  return chart;
}

Chart contact_force_chart(const Run& run) {
  Chart chart = chart_of(run, with_bands(run, "contact forces"));
  Panel panel{"Contact force [N]", {}, true};
  for (std::size_t c = 0; c < run.scene.contacts.size(); ++c) {
    const std::string& name = run.scene.contacts[c].name;
    Curve curve = curve_of(run, name, [c](const PoseResult& pose) {
      return c < pose.contacts.size() ? pose.contacts[c].force : kNoNumber;
    });
    add_band(run, "contacts/" + name + "/force", 1, curve);
    panel.curves.push_back(std::move(curve));
  }
  if (!panel.curves.empty()) chart.panels = {panel};
  return chart;
}

Chart contact_place_chart(const Run& run) {
  Chart chart = chart_of(run, "contact on the tibia");
  if (!run.scene.joint) return chart;
  Panel forward{"Anterior [mm]", {}}, outward{"Lateral [mm]", {}};
  for (std::size_t c = 0; c < run.scene.contacts.size(); ++c) {
    forward.curves.push_back(place_curve(run, c, run.scene.joint->tibia.anterior));
    outward.curves.push_back(place_curve(run, c, run.scene.joint->tibia.lateral));
  }
  keep(chart, forward);
  keep(chart, outward);
  return chart;
}

Chart contact_pressure_chart(const Run& run) {
  Chart chart = chart_of(run, "pressure of the layers");
  Panel pressure{"Greatest pressure [MPa]", {}, true}, area{"Area [mm²]", {}, true};
  const auto add = [&](Panel& panel, std::size_t c, double LayerResult::*what) {
    panel.curves.push_back(curve_of(run, run.scene.contacts[c].name, [=](const PoseResult& pose) {
      if (c >= pose.contacts.size()) return kNoNumber;
      const ContactResult& contact = pose.contacts[c];
      return contact.layer ? (*contact.layer).*what : 0;
    }));
  };
  for (std::size_t c = 0; c < run.scene.contacts.size(); ++c) {
    if (!run.scene.contacts[c].layer) continue;
    add(pressure, c, &LayerResult::peak_pressure);
    add(area, c, &LayerResult::area);
  }
  keep(chart, pressure);
  keep(chart, area);
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

Chart ligament_strain_chart(const Run& run) {
  const auto groups = ligament_groups(run.scene);
  const bool strands = std::any_of(groups.begin(), groups.end(),
                                   [](const auto& group) { return group.members.size() > 1; });
  Chart chart =
      chart_of(run, strands ? "ligament strains (greatest of the strands)" : "ligament strains");
  Panel panel{"Ligament strain [%]", {}, false, kLeastStrain};
  for (const LigamentBundle& group : groups) {
    Curve curve = curve_of(run, group.name, [&](const PoseResult& pose) {
      return 100 * greatest_strain(run.scene, pose, group.members);
    });
    if (has_value(curve)) panel.curves.push_back(std::move(curve));
  }
  keep(chart, panel);
  return chart;
}

Chart wrap_angle_chart(const Run& run) {
  const Scene& scene = run.scene;
  Chart chart = chart_of(run, "angle of wrapping (greatest of the strands)");
  Panel panel{"Angle on the surface [°]", {}, true};
  for (const LigamentBundle& group : ligament_groups(scene))
    for (std::size_t w = 0; w < scene.wraps.size(); ++w) {
      const auto angle = [&](const PoseResult& pose) {
        return kDegrees * greatest_turn(scene, pose, group.members, static_cast<int>(w));
      };
      Curve curve = curve_of(run, group.name + " on " + scene.wraps[w].name, angle);
      if (has_value(curve)) panel.curves.push_back(std::move(curve));
    }
  keep(chart, panel);
  return chart;
}

Chart flexion_moment_chart(const Run& run) {
  Chart chart = chart_of(run, "flexion moment of the knee");
  if (run.kind() == RunKind::kSimulation) return chart;
  for (std::size_t i = 0; i < run.scene.conditions.size(); ++i) {
    if (run.scene.conditions[i].kind != ConditionKind::kFlexion) continue;
    keep(chart, {"Flexion moment [N mm]", {curve_of(run, "", [i](const PoseResult& pose) {
                   return i < pose.conditions.size() ? pose.conditions[i].multiplier : kNoNumber;
                 })}});
    break;
  }
  return chart;
}

Chart stability_chart(const Run& run) {
  Chart chart = chart_of(run, "stability");
  keep(chart, {"Lowest stiffness [N/mm]",
               {curve_of(run, "", [](const PoseResult& pose) { return pose.lowest_stiffness; })}});
  return chart;
}

Chart energy_chart(const Run& run) {
  Chart chart = chart_of(run, "energy");
  const std::optional<MotionView> motion = motion_view(run);
  if (!motion || motion->energies.empty()) return chart;
  constexpr double kJoule = 1e3;  // N mm
  const auto curve = [&](const std::string& title, double MotionEnergies::*part) {
    Curve joules{title, {}, {}};
    for (const MotionEnergies& frame : motion->energies) {
      joules.x.push_back(frame.time);
      joules.y.push_back((frame.*part - motion->energies.front().*part) / kJoule);
    }
    return joules;
  };
  Panel parts{"Energy since the start [J]", {}};
  parts.curves = {curve("kinetic", &MotionEnergies::kinetic),
                  curve("gravity", &MotionEnergies::gravity),
                  curve("ligaments", &MotionEnergies::elastic),
                  curve("dissipated", &MotionEnergies::dissipated),
                  curve("work of loads", &MotionEnergies::work)};
  if (motion->layered)
    parts.curves.insert(parts.curves.begin() + 3, curve("layers", &MotionEnergies::layers));
  const Panel balance = balance_panel(curve("", &MotionEnergies::balance));
  chart.panels = {parts, balance};
  return chart;
}

std::vector<NamedChart> run_charts(const Run& run) {
  if (run.sweep.poses.empty()) return {};
  return {{"joint_coordinates", joint_coordinate_chart(run)},
          {"contact_forces", contact_force_chart(run)},
          {"contact_places", contact_place_chart(run)},
          {"contact_pressures", contact_pressure_chart(run)},
          {"ligament_forces", ligament_force_chart(run)},
          {"ligament_strains", ligament_strain_chart(run)},
          {"wrap_angles", wrap_angle_chart(run)},
          {"flexion_moment", flexion_moment_chart(run)},
          {"stability", stability_chart(run)},
          {"energy", energy_chart(run)}};
}

}  // namespace condyle
