#include "condyle/results/path_group.h"

#include <algorithm>
#include <array>

#include "condyle/math/no_number.h"
#include "condyle/results/run_layout.h"
#include "condyle/scene/ligament_path.h"

namespace condyle {
namespace {

using Poses = std::vector<PoseResult>;

struct TouchColumn {
  const char* name;
  const char* units;
  std::size_t width;
  double* (*data)(LineTouch& touch);
  double unit = 1;
};

/// Places and tangents in the frame of the wrap's body, from the end on the fixed body on.
constexpr std::array<TouchColumn, 7> kColumns = {{
    {"first_point", "mm", 3, [](LineTouch& touch) { return touch.P.data(); }},
    {"last_point", "mm", 3, [](LineTouch& touch) { return touch.Q.data(); }},
    {"first_tangent", "1", 3, [](LineTouch& touch) { return touch.t_P.data(); }},
    {"last_tangent", "1", 3, [](LineTouch& touch) { return touch.t_Q.data(); }},
    {"arc", "mm", 1, [](LineTouch& touch) { return &touch.arc; }},
    {"angle", "deg", 1, [](LineTouch& touch) { return &touch.turn; }, kDegree},
    {"side", "1", 3, [](LineTouch& touch) { return touch.side.data(); }},
}};

/// How a ligament lay at a pose; null where that has no place.
const LigamentPath* path_at(const PoseResult& pose, std::size_t index) {
  if (!pose.solved() || index >= pose.paths.size()) return nullptr;
  return &pose.paths[index];
}

void write_corners(const Hdf5Group& group, const Poses& poses, std::size_t index) {
  std::vector<int> first = {0};
  std::vector<double> points;
  for (const PoseResult& pose : poses) {
    if (const LigamentPath* path = path_at(pose, index))
      for (const Eigen::Vector3d& point : path->points)
        points.insert(points.end(), point.data(), point.data() + 3);
    first.push_back(static_cast<int>(points.size() / 3));
  }
  group.write("first", first, {first.size()}, "1");
  group.write("points", points, {points.size() / 3, 3}, "mm");
}

void read_corners(const Hdf5Group& group, Poses& poses, std::size_t index) {
  const std::vector<int> first = group.read_integers("first", {poses.size() + 1});
  if (first.front() != 0 || !std::is_sorted(first.begin(), first.end()))
    group.fail("dataset first does not rise from 0");
  const std::vector<double> points =
      group.read("points", {static_cast<std::size_t>(first.back()), 3});
  for (std::size_t i = 0; i < poses.size(); ++i)
    for (int k = first[i]; k < first[i + 1]; ++k)
      poses[i].paths[index].points.emplace_back(
          Eigen::Map<const Eigen::Vector3d>(&points[3 * static_cast<std::size_t>(k)]));
}

}  // namespace

void write_path(const Hdf5Group& ligament,
                const Scene& scene,
                const Poses& poses,
                std::size_t index) {
  const LigamentDescription& described = scene.ligaments[index];
  const std::size_t wraps = described.path.wraps.size(), n = poses.size();
  if (wraps == 0) return;
  const Hdf5Group group = ligament.create("path");
  std::vector<int> touching(n * wraps, -1);
  std::array<std::vector<double>, kColumns.size()> values;
  for (std::size_t c = 0; c < kColumns.size(); ++c)
    values[c].assign(n * wraps * kColumns[c].width, kNoNumber);
  for (std::size_t i = 0; i < n; ++i) {
    const LigamentPath* path = path_at(poses[i], index);
    for (std::size_t w = 0; path != nullptr && w < path->touches.size(); ++w) {
      LineTouch touch = path->touches[w];
      touching[i * wraps + w] = touch.touching ? 1 : 0;
      for (std::size_t c = 0; c < kColumns.size(); ++c)
        for (std::size_t k = 0; k < kColumns[c].width; ++k)
          values[c][(i * wraps + w) * kColumns[c].width + k] =
              kColumns[c].data(touch)[k] / kColumns[c].unit;
    }
  }
  group.write("touching", touching, {n, wraps}, "1");
  std::vector<std::string> names;
  for (std::size_t w = 0; w < wraps; ++w)
    names.push_back(
        scene.wraps[static_cast<std::size_t>(wrap_on_path(scene, described, static_cast<int>(w)))]
            .name);
  group.write_attribute("touching", "meaning", names);
  for (std::size_t c = 0; c < kColumns.size(); ++c)
    group.write(kColumns[c].name, values[c],
                kColumns[c].width > 1 ? Shape{n, wraps, kColumns[c].width} : Shape{n, wraps},
                kColumns[c].units);
  write_corners(group, poses, index);
}

void read_path(const Hdf5Group& ligament, const Scene& scene, Poses& poses, std::size_t index) {
  const LigamentDescription& described = scene.ligaments[index];
  const std::size_t wraps = described.path.wraps.size(), n = poses.size();
  if (wraps == 0 || !ligament.has("path")) return;
  const Hdf5Group group = ligament.open("path");
  const std::vector<int> touching = group.read_integers("touching", {n, wraps});
  for (PoseResult& pose : poses) pose.paths.resize(scene.ligaments.size());
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t w = 0; w < wraps && touching[i * wraps] >= 0; ++w) {
      LineTouch& touch = poses[i].paths[index].touches.emplace_back();
      touch.touching = touching[i * wraps + w] == 1;
      const int wrap = wrap_on_path(scene, described, static_cast<int>(w));
      touch.on_moving = scene.wraps[static_cast<std::size_t>(wrap)].body == scene.moving_body();
    }
  for (const TouchColumn& column : kColumns) {
    const std::vector<double> values =
        group.read(column.name, column.width > 1 ? Shape{n, wraps, column.width} : Shape{n, wraps});
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t w = 0; w < poses[i].paths[index].touches.size(); ++w) {
        LineTouch& touch = poses[i].paths[index].touches[w];
        for (std::size_t k = 0; k < column.width; ++k)
          column.data(touch)[k] = values[(i * wraps + w) * column.width + k] * column.unit;
      }
  }
  read_corners(group, poses, index);
}

}  // namespace condyle
