#include "condyle/results/sensitivity_group.h"

#include <functional>

namespace condyle {
namespace {

using Texts = std::vector<std::string>;

/// What one unit of the derivative as told is inside.
double inside_per_shown(const SweepSensitivities& s, std::size_t i, std::size_t j) {
  return s.outputs[i].unit.factor / s.parameters[j].unit.factor;
}

using EnterGroup = std::function<Hdf5Group(const Hdf5Group& parent, const std::string& name)>;
using AtDataset = std::function<void(const Hdf5Group& parent, const std::string& name)>;

/// Enters the groups of "contacts/medial/force" one after the other, down to its dataset.
void walk(const Hdf5Group& group,
          const std::string& place,
          const EnterGroup& enter,
          const AtDataset& at_dataset) {
  const std::size_t slash = place.find('/');
  if (slash == std::string::npos) return at_dataset(group, place);
  walk(enter(group, place.substr(0, slash)), place.substr(slash + 1), enter, at_dataset);
}

Texts names_of(const SweepSensitivities& s) {
  Texts names;
  for (const SceneParameter& parameter : s.parameters) names.push_back(parameter.name);
  return names;
}

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

double shown_derivative(const SweepSensitivities& sensitivities,
                        std::size_t pose,
                        std::size_t i,
                        std::size_t j) {
  return sensitivities.by_pose[pose](index(i), index(j)) / inside_per_shown(sensitivities, i, j);
}

void write_sensitivities(const Hdf5Group& group, const SweepSensitivities& sensitivities) {
  const std::size_t n = sensitivities.by_pose.size(), width = sensitivities.parameters.size();
  Texts units;
  for (const SceneParameter& parameter : sensitivities.parameters)
    units.push_back(parameter.unit.name);
  group.write("parameters", names_of(sensitivities));
  group.write("parameter_units", units);
  group.write("one_sided", sensitivities.one_sided);
  const EnterGroup enter = [](const Hdf5Group& parent, const std::string& name) {
    return parent.has(name) ? parent.open(name) : parent.create(name);
  };
  for (std::size_t i = 0; i < sensitivities.outputs.size(); ++i) {
    std::vector<double> values(n * width);
    for (std::size_t pose = 0; pose < n; ++pose)
      for (std::size_t j = 0; j < width; ++j)
        values[pose * width + j] = shown_derivative(sensitivities, pose, i, j);
    const SensitivityOutput& output = sensitivities.outputs[i];
    walk(group, output.place, enter, [&](const Hdf5Group& parent, const std::string& name) {
      parent.write(name, values, {n, width}, output.unit.name + "/parameter");
    });
  }
}

std::shared_ptr<const SweepSensitivities> read_sensitivities(const Hdf5Group& group,
                                                             const Scene& scene,
                                                             std::size_t poses) {
  const auto read = std::make_shared<SweepSensitivities>();
  read->outputs = sensitivity_outputs(scene);
  read->parameters = scene_parameters(scene, scene.sweep->sensitivities);
  if (group.read_texts("parameters") != names_of(*read))
    group.fail("dataset parameters does not hold the numbers that the scene asks for");
  read->one_sided = group.read_texts("one_sided");
  if (read->one_sided.size() != poses)
    group.fail("dataset one_sided has not one text for each value");
  const std::size_t width = read->parameters.size();
  read->by_pose.assign(poses, Eigen::MatrixXd(index(read->outputs.size()), index(width)));
  const EnterGroup enter = [](const Hdf5Group& parent, const std::string& name) {
    return parent.open(name);
  };
  for (std::size_t i = 0; i < read->outputs.size(); ++i) {
    std::vector<double> values;
    walk(group, read->outputs[i].place, enter,
         [&](const Hdf5Group& parent, const std::string& name) {
           values = parent.read(name, {poses, width});
         });
    for (std::size_t pose = 0; pose < poses; ++pose)
      for (std::size_t j = 0; j < width; ++j)
        read->by_pose[pose](index(i), index(j)) =
            values[pose * width + j] * inside_per_shown(*read, i, j);
  }
  return read;
}

}  // namespace condyle
