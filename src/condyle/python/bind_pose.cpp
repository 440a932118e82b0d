#include <algorithm>

#include <pybind11/numpy.h>

#include "condyle/math/no_number.h"
#include "condyle/python/bindings.h"

namespace condyle::python {
namespace {

using Pose = std::shared_ptr<PoseData>;

/// A pose alone is the only row of its columns.
py::object part(const Pose& pose, const std::string& place) {
  return at_place(pose, pose->tree_at(place), place, 0);
}

py::object part_or_none(const Pose& pose, const std::string& name) {
  return pose->tree_at(name).group(name) == nullptr ? py::none() : part(pose, name);
}

using Array = py::array_t<double>;

/// The quick ways to numbers of one pose, past the columns; NaN where it was not found.
template <typename Fill>
Array numbers_of(const PoseData& data, const std::vector<py::ssize_t>& shape, const Fill& fill) {
  Array array(shape);
  double* out = array.mutable_data();
  if (data.pose().solved())
    fill(data.pose(), out);
  else
    std::fill_n(out, array.size(), kNoNumber);
  return array;
}

Array translation_of(const PoseData& data) {
  return numbers_of(data, {3}, [](const PoseResult& pose, double* out) {
    std::copy_n(pose.X_BA.p.data(), 3, out);
  });
}

Array rotation_of(const PoseData& data) {
  return numbers_of(data, {3, 3}, [](const PoseResult& pose, double* out) {
    for (int i = 0; i < 9; ++i) out[i] = pose.X_BA.R(i / 3, i % 3);
  });
}

template <typename T>
void put_forces(const std::vector<T>& all, double* out) {
  for (const T& one : all) *out++ = one.force;
}

Array ligament_forces(const PoseData& data) {
  const auto count = static_cast<py::ssize_t>(data.scene().ligaments.size());
  return numbers_of(data, {count},
                    [](const PoseResult& pose, double* out) { put_forces(pose.ligaments, out); });
}

Array contact_forces(const PoseData& data) {
  const auto count = static_cast<py::ssize_t>(data.scene().contacts.size());
  return numbers_of(data, {count},
                    [](const PoseResult& pose, double* out) { put_forces(pose.contacts, out); });
}

py::object status_of(const PoseData& pose) {
  static const py::handle kStatus =
      py::object(py::module_::import("condyle").attr("Status")).release();
  return kStatus(static_cast<int>(pose.pose().status));
}

}  // namespace

void bind_pose(py::module_& m) {
  py::list statuses;
  for (int i = 0; i < kPoseStatusCount; ++i) statuses.append(name(static_cast<PoseStatus>(i)));
  m.attr("_status_names") = statuses;
  py::class_<PoseData, Pose> type(
      m, "Pose",
      "One position of equilibrium, or the reason why there is none. "
      "Lengths in mm, forces in N, moments\n"
      "in N mm, angles in deg, whatever the scene's units; numbers of a "
      "pose that was not found are NaN.");
  only_returned(type);
  type.def_property_readonly(
          "status", [](const PoseData& pose) { return status_of(pose); },
          "How the search ended: a Status.")
      .def_property_readonly(
          "converged", [](const PoseData& pose) { return pose.pose().converged(); },
          "True where the pose was found, within the known surfaces.")
      .def_property_readonly(
          "reason", [](const PoseData& pose) { return pose.pose().reason; },
          "One line where it was not; else empty.")
      .def_property_readonly(
          "remark", [](const PoseData& pose) { return pose.pose().remark; },
          "What a reader should know of a pose that was found; mostly empty.")
      .def_property_readonly("translation", &translation_of,
                             "Origin of the moving body in the ground frame, (3,) [mm].")
      .def_property_readonly(
          "rotation", &rotation_of,
          "Rotation of the moving body, (3, 3), columns are its axes in the ground frame.")
      .def_property_readonly(
          "joint", [](const Pose& pose) { return part_or_none(pose, "joint"); },
          "Group: flexion, adduction, internal_rotation [deg], lateral_shift, anterior_drawer,\n"
          "distraction [mm]; None without [joint].")
      .def_property_readonly("ligament_forces", &ligament_forces,
                             "Of all ligaments in the order of Model.ligaments, (m,) [N].")
      .def_property_readonly("contact_forces", &contact_forces,
                             "Of all contacts in the order of Model.contacts, (k,) [N].")
      .def_property_readonly(
          "ligaments", [](const Pose& pose) { return part(pose, "ligaments"); },
          "Group by name: force [N], length [mm], strain.")
      .def_property_readonly(
          "contacts", [](const Pose& pose) { return part(pose, "contacts"); },
          "Group by name: state (1 closed), force [N], point_ground, gap [mm] ...")
      .def_property_readonly(
          "conditions", [](const Pose& pose) { return part(pose, "conditions"); },
          "Group by name: value [deg or mm], multiplier [N mm or N].")
      .def_property_readonly(
          "stability", [](const Pose& pose) { return part(pose, "stability"); },
          "Group: stable (1, 0; -1 not examined), lowest_stiffness [N/mm].")
      .def_property_readonly(
          "iterations", [](const PoseData& pose) { return pose.pose().iterations; },
          "Iterations of Newton's method.")
      .def_property_readonly(
          "residual", [](const PoseData& pose) { return pose.pose().residual; },
          "Largest force out of balance [N].")
      .def(
          "__getitem__",
          [](const Pose& pose, const std::string& place) { return part(pose, place); },
          py::arg("place"),
          "What stands there under /sweep of a result file: pose[\"ligaments/aACL/force\"].")
      .def("__repr__", [](const PoseData& pose) {
        return std::string("<condyle.Pose: ") + name(pose.pose().status) +
               (pose.pose().reason.empty() ? "" : ", " + pose.pose().reason) + ">";
      });
}

}  // namespace condyle::python
