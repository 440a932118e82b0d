#include "condyle/results/patch_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "condyle/results/points_dataset.h"
#include "condyle/results/run_layout.h"
#include "condyle/results/run_view.h"
#include "condyle/surface/bspline_basis.h"

namespace condyle {
namespace {

void write_fit(const Hdf5Group& patch, const FitReport& report) {
  patch.write("rms_mm", std::vector<double>{report.rms}, {}, "mm");
  patch.write("max_mm", std::vector<double>{report.max}, {}, "mm");
  const Hdf5Group fit = patch.create("fit");
  for (const auto& column : kFitColumns) {
    fit.write(column.name, std::vector<double>{report.*column.member / column.unit}, {},
              column.units);
  }
  fit.write("mesh_vertices", std::vector<int>{report.mesh_vertices}, {}, "1");
  fit.write("curvature_range",
            std::vector<double>(report.curvature_range.begin(), report.curvature_range.end()), {2},
            "1/mm");
  fit.write("extent", std::vector<double>(report.extent.begin(), report.extent.end()), {2}, "mm");
  fit.write("turn", std::vector<double>{report.turn[0] / kDegree, report.turn[1] / kDegree}, {2},
            "deg");
  fit.write("notes", report.notes);
}

FitReport read_fit(const Hdf5Group& patch, const std::string& surface, const PatchData& data) {
  FitReport report;
  report.surface = surface;
  report.control_points = {data.nu, data.nv};
  report.rms = patch.read("rms_mm", {})[0];
  report.max = patch.read("max_mm", {})[0];
  const Hdf5Group fit = patch.open("fit");
  for (const auto& column : kFitColumns)
    report.*column.member = fit.read(column.name, {})[0] * column.unit;
  report.mesh_vertices = fit.read_integers("mesh_vertices", {})[0];
  const std::vector<double> range = fit.read("curvature_range", {2});
  report.curvature_range = {range[0], range[1]};
  const std::vector<double> extent = fit.read("extent", {2}), turn = fit.read("turn", {2});
  report.extent = {extent[0], extent[1]};
  report.turn = {kDegree * turn[0], kDegree * turn[1]};
  report.notes = fit.read_texts("notes");
  return report;
}

/// Knots ascend over the parameter box, and descend nowhere.
std::vector<double> read_knots(const Hdf5Group& group,
                               const char* name,
                               std::size_t points,
                               int degree) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<double> knots = group.read(name, {points + p + 1});
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const bool inside = i > p && i <= points;
    const bool ascends = i == 0 || (inside ? knots[i - 1] < knots[i] : knots[i - 1] <= knots[i]);
    if (!std::isfinite(knots[i]) || !ascends)
      group.fail(fmt::format("dataset {} holds no knots that ascend", name));
  }
  return knots;
}

void read_mask(const Hdf5Group& group, PatchData& data) {
  Hdf5Array mask = group.read("mask");
  const bool grid =
      mask.shape.size() == 2 && (mask.values.empty() || std::min(mask.shape[0], mask.shape[1]) > 1);
  if (!grid || !are_finite(mask.values)) group.fail("dataset mask is not a grid of numbers");
  if (!mask.values.empty()) {
    data.mask_nu = static_cast<int>(mask.shape[0]) - 1;
    data.mask_nv = static_cast<int>(mask.shape[1]) - 1;
  }
  data.mask = std::move(mask.values);
}

}  // namespace

void write_patch(const Hdf5Group& group, const RunPatch& patch, const Scene& scene) {
  const PatchData& data = patch.data;
  const auto size = [](int n) { return static_cast<std::size_t>(n); };
  group.write_attribute("body", scene.bodies.at(size(patch.body)).name);
  group.write("degree", std::vector<int>(data.degree.begin(), data.degree.end()), {2}, "1");
  group.write("knots_u", data.knots_u, {data.knots_u.size()}, "mm");
  group.write("knots_v", data.knots_v, {data.knots_v.size()}, "mm");
  group.write("control_points", coordinates(data.control_points), {size(data.nu), size(data.nv), 3},
              "mm");
  group.write("orientation", std::vector<int>{data.orientation}, {}, "1");
  const Shape mask =
      data.mask.empty() ? Shape{0, 0} : Shape{size(data.mask_nu) + 1, size(data.mask_nv) + 1};
  group.write("mask", data.mask, mask, "mm");
  write_fit(group, patch.report);
}

RunPatch read_patch(const Hdf5Group& group, const std::string& surface, const Scene& scene) {
  RunPatch patch;
  patch.surface = surface;
  patch.body = body_named(scene, group.read_attribute("body"));
  PatchData& data = patch.data;
  const std::vector<int> degree = group.read_integers("degree", {2});
  data.degree = {degree[0], degree[1]};
  Shape net;
  data.control_points = read_points(group, "control_points", net);
  const bool sized = net.size() == 3 && std::min(degree[0], degree[1]) >= 2 &&
                     std::max(degree[0], degree[1]) <= kMaxDegree &&
                     net[0] > static_cast<std::size_t>(degree[0]) &&
                     net[1] > static_cast<std::size_t>(degree[1]);
  if (!sized || patch.body < 0) group.fail("is not a patch of this scene");
  data.nu = static_cast<int>(net[0]);
  data.nv = static_cast<int>(net[1]);
  data.knots_u = read_knots(group, "knots_u", net[0], degree[0]);
  data.knots_v = read_knots(group, "knots_v", net[1], degree[1]);
  data.orientation = group.read_integers("orientation", {})[0];
  if (std::abs(data.orientation) != 1) group.fail("dataset orientation is neither 1 nor -1");
  read_mask(group, data);
  patch.report = read_fit(group, surface, data);
  return patch;
}

}  // namespace condyle
