#include "condyle/results/layer_group.h"

#include <algorithm>
#include <array>

#include "condyle/math/no_number.h"

namespace condyle {
namespace {

using Poses = std::vector<PoseResult>;

/// Numbers of a layered contact that lie side by side.
struct LayerColumn {
  const char* name;
  const char* units;
  std::size_t width;
  double* (*data)(LayerResult& layer);
};

constexpr std::array<LayerColumn, 10> kLayerColumns = {{
    {"area", "mm^2", 1, [](LayerResult& layer) { return &layer.area; }},
    {"pressure_mean", "N/mm^2", 1, [](LayerResult& layer) { return &layer.mean_pressure; }},
    {"pressure_max", "N/mm^2", 1, [](LayerResult& layer) { return &layer.peak_pressure; }},
    {"depth", "mm", 1, [](LayerResult& layer) { return &layer.deepest; }},
    {"energy", "N mm", 1, [](LayerResult& layer) { return &layer.energy; }},
    {"error", "1", 1, [](LayerResult& layer) { return &layer.error; }},
    {"lost_force", "1", 1, [](LayerResult& layer) { return &layer.lost; }},
    {"lateral_ratio", "1", 1, [](LayerResult& layer) { return &layer.lateral; }},
    {"force_ground", "N", 3, [](LayerResult& layer) { return layer.force.data(); }},
    {"moment", "N mm", 3, [](LayerResult& layer) { return layer.moment.data(); }},
}};

/// Numbers of a point of the field.
struct FieldColumn {
  const char* name;
  const char* units;
  std::size_t width;
  double* (*data)(PressurePoint& point);
};

constexpr std::array<FieldColumn, 5> kFieldColumns = {{
    {"place", "mm", 2, [](PressurePoint& point) { return point.place.data(); }},
    {"point", "mm", 3, [](PressurePoint& point) { return point.point.data(); }},
    {"pressure", "N/mm^2", 1, [](PressurePoint& point) { return &point.pressure; }},
    {"depth", "mm", 1, [](PressurePoint& point) { return &point.depth; }},
    {"area", "mm^2", 1, [](PressurePoint& point) { return &point.area; }},
}};

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Names of the two surfaces, the fixed body's first.
std::array<std::string, 2> surface_names(const Scene& scene, std::size_t index) {
  auto [first, second] = scene.contacts[index].surfaces;
  if (scene.surfaces[at(first)].body != scene.fixed_body()) std::swap(first, second);
  return {scene.surfaces[at(first)].name, scene.surfaces[at(second)].name};
}

/// Is there an area at the pose?
bool pressed(const PoseResult& pose, std::size_t index) {
  return pose.solved() && pose.contacts.at(index).layer.has_value();
}

/// One row a pose, NaN where nothing is pressed.
template <typename Fill>
void write_rows(const Hdf5Group& contact,
                const char* name,
                const char* units,
                std::size_t width,
                const Poses& poses,
                std::size_t index,
                const Fill& fill) {
  std::vector<double> values(width * poses.size(), kNoNumber);
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (pressed(poses[i], index)) fill(poses[i], &values[width * i]);
  contact.write(name, values, with_width({poses.size()}, width), units);
}

/// The points of all poses one after the other; those of pose i from first[i] on.
void write_field(const Hdf5Group& group, const Poses& poses, std::size_t index, bool on_A) {
  std::vector<int> first = {0};
  std::vector<PressurePoint> points;
  for (const PoseResult& pose : poses) {
    if (pressed(pose, index))
      for (const PressurePoint& point : pose.contacts[index].pressures)
        if (point.on_A == on_A) points.push_back(point);
    first.push_back(static_cast<int>(points.size()));
  }
  group.write("first", first, {first.size()}, "1");
  for (const FieldColumn& column : kFieldColumns) {
    std::vector<double> values;
    values.reserve(column.width * points.size());
    for (PressurePoint& point : points) {
      const double* data = column.data(point);
      values.insert(values.end(), data, data + column.width);
    }
    group.write(column.name, values, with_width({points.size()}, column.width), column.units);
  }
}

void read_field(const Hdf5Group& group, Poses& poses, std::size_t index, bool on_A) {
  const std::vector<int> first = group.read_integers("first", {poses.size() + 1});
  const auto count = at(std::max(0, first.back()));
  if (first.front() != 0 || !std::is_sorted(first.begin(), first.end()))
    group.fail("dataset first does not rise from 0");
  std::vector<PressurePoint> points;
  for (const FieldColumn& column : kFieldColumns) {
    const std::vector<double> values = group.read(column.name, with_width({count}, column.width));
    points.resize(count);  // so many are there
    for (std::size_t k = 0; k < count; ++k)
      std::copy_n(&values[k * column.width], column.width, column.data(points[k]));
  }
  for (PressurePoint& point : points) point.on_A = on_A;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    std::vector<PressurePoint>& all = poses[i].contacts[index].pressures;
    all.insert(all.end(), points.begin() + first[i], points.begin() + first[i + 1]);
  }
}

void take_rows(const Hdf5Group& contact,
               const LayerColumn& column,
               Poses& poses,
               std::size_t index) {
  const std::vector<double> values =
      contact.read(column.name, with_width({poses.size()}, column.width));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double* row = &values[i * column.width];
    std::optional<LayerResult>& layer = poses[i].contacts[index].layer;
    if (row[0] != row[0]) continue;
    if (!layer) layer.emplace();
    std::copy_n(row, column.width, column.data(*layer));
  }
}

}  // namespace

void write_layers(const Hdf5Group& contact,
                  const Scene& scene,
                  const Poses& poses,
                  std::size_t index) {
  if (!scene.contacts[index].layer) return;
  for (const LayerColumn& column : kLayerColumns)
    write_rows(contact, column.name, column.units, column.width, poses, index,
               [&](const PoseResult& pose, double* row) {
                 LayerResult layer = *pose.contacts[index].layer;
                 std::copy_n(column.data(layer), column.width, row);
               });
  write_rows(contact, "center_of_pressure", "mm", 3, poses, index,
             [&](const PoseResult& pose, double* row) {
               std::copy_n(pose.contacts[index].resultant_ground.data(), 3, row);
             });
  write_rows(contact, "center_of_pressure_moving", "mm", 3, poses, index,
             [&](const PoseResult& pose, double* row) {
               const Eigen::Vector3d there =
                   pose.X_BA.inverse() * pose.contacts[index].resultant_ground;
               std::copy_n(there.data(), 3, row);
             });
  std::vector<int> cells;
  for (const PoseResult& pose : poses)
    cells.push_back(pressed(pose, index) ? pose.contacts[index].layer->points : 0);
  contact.write("cells", cells, {poses.size()}, "1");
  const Hdf5Group pressure = contact.create("pressure");
  const std::array<std::string, 2> names = surface_names(scene, index);
  for (const bool on_A : {false, true})
    write_field(pressure.create(names[on_A]), poses, index, on_A);
}

void read_layers(const Hdf5Group& contact, const Scene& scene, Poses& poses, std::size_t index) {
  if (!contact.has("pressure")) return;
  for (const LayerColumn& column : kLayerColumns) take_rows(contact, column, poses, index);
  const std::vector<int> cells = contact.read_integers("cells", {poses.size()});
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (std::optional<LayerResult>& layer = poses[i].contacts[index].layer)
      layer->points = cells[i];
  const Hdf5Group pressure = contact.open("pressure");
  const std::array<std::string, 2> names = surface_names(scene, index);
  for (const bool on_A : {false, true}) read_field(pressure.open(names[on_A]), poses, index, on_A);
}

}  // namespace condyle
