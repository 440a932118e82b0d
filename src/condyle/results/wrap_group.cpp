#include "condyle/results/wrap_group.h"

#include <algorithm>
#include <array>

#include "condyle/results/run_layout.h"
#include "condyle/scene/ligament_path.h"

namespace condyle {
namespace {

constexpr std::array<Column<BoneFit>, 5> kFigures = {{
    {"region", "mm", &BoneFit::region},
    {"rms", "mm", &BoneFit::rms},
    {"max", "mm", &BoneFit::max},
    {"length_rms", "mm", &BoneFit::length_rms},
    {"length_max", "mm", &BoneFit::length_max},
}};
constexpr std::array<Column<BoneString>, 5> kStringColumns = {{
    {"flexion", "deg", &BoneString::flexion, kDegree},
    {"straight", "mm", &BoneString::straight},
    {"depth", "mm", &BoneString::depth},
    {"length", "mm", &BoneString::length},
    {"fitted", "mm", &BoneString::fitted},
}};

std::vector<double> numbers(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

void write_strings(const Hdf5Group& group, const Scene& scene, const BoneFit& fit) {
  const std::size_t n = fit.strings.size();
  std::vector<int> ligaments;
  for (const BoneString& string : fit.strings) ligaments.push_back(string.ligament);
  group.write("ligament", ligaments, {n}, "1");
  std::vector<std::string> names;
  for (const LigamentDescription& ligament : scene.ligaments) names.push_back(ligament.name);
  group.write_attribute("ligament", "meaning", names);
  for (const auto& column : kStringColumns) {
    std::vector<double> values;
    for (const BoneString& string : fit.strings)
      values.push_back(string.*column.member / column.unit);
    group.write(column.name, values, {n}, column.units);
  }
}

void write_wrap(const Hdf5Group& group, const Scene& scene, const WrapDescription& wrap) {
  group.write_attribute("body", scene.bodies[static_cast<std::size_t>(wrap.body)].name);
  group.write_attribute("kind", "ellipsoid");
  group.write("center", numbers(wrap.placement.p), {3}, "mm");
  std::vector<double> axes;
  for (int i = 0; i < 9; ++i) axes.push_back(wrap.placement.R(i / 3, i % 3));
  group.write("axes", axes, {3, 3}, "1");
  group.write("semi_axes", numbers(std::get<WrapEllipsoid>(wrap.shape).semi_axes), {3}, "mm");
  const BoneFit& fit = *wrap.fit;
  group.write("side", numbers(fit.side), {3}, "mm");
  group.write("vertices", std::vector<int>{fit.vertices}, {}, "1");
  for (const auto& figure : kFigures)
    group.write(figure.name, std::vector<double>{fit.*figure.member}, {}, figure.units);
  write_strings(group.create("strings"), scene, fit);
}

Eigen::Vector3d read_vector(const Hdf5Group& group, const char* name) {
  return Eigen::Map<const Eigen::Vector3d>(group.read(name, {3}).data());
}

void read_strings(const Hdf5Group& group, const Scene& scene, BoneFit& fit) {
  const std::size_t n = group.read("ligament").values.size();
  const std::vector<int> ligaments = group.read_integers("ligament", {n});
  fit.strings.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (ligaments[i] < 0 || ligaments[i] >= static_cast<int>(scene.ligaments.size()))
      group.fail("holds a string of no known ligament");
    fit.strings[i].ligament = ligaments[i];
  }
  for (const auto& column : kStringColumns) {
    const std::vector<double> values = group.read(column.name, {n});
    for (std::size_t i = 0; i < n; ++i) fit.strings[i].*column.member = values[i] * column.unit;
  }
}

void read_wrap(const Hdf5Group& group, const Scene& scene, WrapDescription& wrap) {
  const Eigen::Vector3d semi_axes = read_vector(group, "semi_axes");
  if (!(semi_axes.minCoeff() > 0)) group.fail("semi_axes are not all > 0");
  wrap.shape = WrapEllipsoid{semi_axes};
  wrap.placement.p = read_vector(group, "center");
  const std::vector<double> axes = group.read("axes", {3, 3});
  for (int i = 0; i < 9; ++i) wrap.placement.R(i / 3, i % 3) = axes[static_cast<std::size_t>(i)];
  BoneFit& fit = *wrap.fit;
  fit.side = read_vector(group, "side");
  fit.vertices = group.read_integers("vertices", {})[0];
  for (const auto& figure : kFigures) fit.*figure.member = group.read(figure.name, {})[0];
  read_strings(group.open("strings"), scene, fit);
  fit.done = true;
}

}  // namespace

void write_wraps(const Hdf5Group& root, const Scene& scene) {
  const auto fitted = [](const WrapDescription& wrap) { return wrap.fit && wrap.fit->done; };
  if (std::none_of(scene.wraps.begin(), scene.wraps.end(), fitted)) return;
  const Hdf5Group wraps = root.create("wraps");
  for (const WrapDescription& wrap : scene.wraps)
    if (fitted(wrap)) write_wrap(wraps.create(wrap.name), scene, wrap);
}

void read_fitted_wraps(const Hdf5Group& root, Scene& scene) {
  bool any = false;
  for (WrapDescription& wrap : scene.wraps) {
    if (!wrap.fit) continue;
    any = true;
    read_wrap(root.open("wraps").open(wrap.name), scene, wrap);
  }
  if (any) settle_fitted_paths(scene);
}

}  // namespace condyle
