#include "condyle/exchange/pressure_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "condyle/calibration/csv_text.h"
#include "condyle/exchange/run_table.h"
#include "condyle/exchange/vtk_file.h"

namespace condyle {
namespace {

/// The surface that a point of a contact lies on.
const SurfaceDescription& surface_of(const Scene& scene,
                                     const ContactDescription& contact,
                                     bool on_A) {
  const SurfaceDescription& first = scene.surfaces[static_cast<std::size_t>(contact.surfaces[0])];
  if ((first.body != scene.fixed_body()) == on_A) return first;
  return scene.surfaces[static_cast<std::size_t>(contact.surfaces[1])];
}

/// `take` is told contact, surface, the point and where it is in the ground frame.
template <typename Take>
void each_pressure(const Scene& scene, const PoseResult& pose, const Take& take) {
  for (std::size_t i = 0; i < scene.contacts.size() && i < pose.contacts.size(); ++i)
    for (const PressurePoint& point : pose.contacts[i].pressures)
      take(scene.contacts[i].name, surface_of(scene, scene.contacts[i], point.on_A).name, point,
           point.on_A ? Eigen::Vector3d(pose.X_BA * point.point) : point.point);
}

}  // namespace

bool has_layers(const Run& run) {
  return std::any_of(run.scene.contacts.begin(), run.scene.contacts.end(),
                     [](const ContactDescription& contact) { return contact.layer.has_value(); });
}

std::string csv_of_pressures(const Run& run, const std::vector<ShownPose>& shown) {
  const SweptQuantity quantity = swept_quantity(run);
  std::string text = std::string(kTableHead) +
                     "contact,surface,u_mm,v_mm,x_mm,y_mm,z_mm,pressure_N/mm2,depth_mm,area_mm2\n";
  for (const ShownPose& step : shown) {
    const PoseResult& pose = run.sweep.poses[step.index];
    const std::string head =
        fmt::format("{},{},{}", step.index, quantity.shown(pose.value), quantity.unit.name);
    each_pressure(run.scene, pose,
                  [&](const std::string& contact, const std::string& surface,
                      const PressurePoint& point, const Eigen::Vector3d& x) {
                    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{}\n",
                                   head, csv_text(contact), csv_text(surface), point.place.x(),
                                   point.place.y(), x.x(), x.y(), x.z(), point.pressure,
                                   point.depth, point.area);
                  });
  }
  return text;
}

std::string pressures_vtp(const Run& run, const PoseResult& pose) {
  VtkPolyData data;
  VtkArray pressure{"pressure_MPa", 1, {}}, depth{"depth_mm", 1, {}}, area{"area_mm2", 1, {}};
  each_pressure(run.scene, pose,
                [&](const std::string& contact, const std::string& surface,
                    const PressurePoint& point, const Eigen::Vector3d& x) {
                  data.points.push_back(x);
                  data.cell_names.push_back(contact + "/" + surface);
                  pressure.values.push_back(point.pressure);
                  depth.values.push_back(point.depth);
                  area.values.push_back(point.area);
                });
  data.point_data = {pressure, depth, area};
  return vtp_bytes(data);
}

}  // namespace condyle
