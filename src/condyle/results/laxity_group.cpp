#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "condyle/results/comparison_groups.h"
#include "condyle/results/run_layout.h"

namespace condyle {
namespace {

std::string state_name(bool cut) { return cut ? "cut" : "intact"; }

/// Numbers of all poses of all curves of one kind, [flexions, loads].
using OfPose = std::function<double(const PoseResult&)>;
std::vector<double> grid(const std::vector<const SweepResult*>& sweeps, const OfPose& of) {
  std::vector<double> values;
  for (const SweepResult* sweep : sweeps)
    for (const PoseResult& pose : sweep->poses)
      values.push_back(pose.converged() ? of(pose) : std::nan(""));
  return values;
}

void write_curves(const Hdf5Group& group,
                  const Scene& scene,
                  const std::vector<const SweepResult*>& sweeps) {
  const Shape shape = {sweeps.size(), sweeps.front()->poses.size()};
  std::vector<int> status;
  for (const SweepResult* sweep : sweeps)
    for (const PoseResult& pose : sweep->poses) status.push_back(static_cast<int>(pose.status));
  group.write("status", status, shape, "1");
  const Hdf5Group joint = group.create("joint");
  for (const auto& column : kJointColumns) {
    joint.write(
        column.name,
        grid(sweeps, [&](const PoseResult& p) { return p.joint.*column.member / column.unit; }),
        shape, column.units);
  }
  const Hdf5Group contacts = group.create("contacts"), ligaments = group.create("ligaments");
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    contacts.write(scene.contacts[c].name,
                   grid(sweeps, [c](const PoseResult& p) { return p.contacts.at(c).force; }), shape,
                   "N");
  }
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    ligaments.write(scene.ligaments[i].name,
                    grid(sweeps, [i](const PoseResult& p) { return p.ligaments.at(i).force; }),
                    shape, "N");
  }
}

std::vector<SweepResult> read_curves(const Hdf5Group& group,
                                     const Scene& scene,
                                     std::size_t flexions) {
  const std::vector<double>& loads = scene.sweep->values;
  const std::size_t n = loads.size();
  std::vector<SweepResult> sweeps(flexions);
  for (SweepResult& sweep : sweeps) sweep.poses.resize(n);
  const auto pose = [&](std::size_t k) -> PoseResult& { return sweeps[k / n].poses[k % n]; };
  const Shape shape = {flexions, n};
  const auto take = [&](const std::vector<double>& values,
                        const std::function<double&(PoseResult&)>& of, double unit) {
    for (std::size_t k = 0; k < values.size(); ++k) of(pose(k)) = values[k] * unit;
  };
  const std::vector<int> status = group.read_integers("status", shape);
  for (std::size_t k = 0; k < status.size(); ++k) {
    if (status[k] < 0 || status[k] >= kPoseStatusCount)
      group.fail(fmt::format("status = {}, which has no meaning", status[k]));
    pose(k).status = static_cast<PoseStatus>(status[k]);
    pose(k).value = loads[k % n];
    pose(k).contacts.resize(scene.contacts.size());
    pose(k).ligaments.resize(scene.ligaments.size());
  }
  const Hdf5Group joint = group.open("joint"), contacts = group.open("contacts"),
                  ligaments = group.open("ligaments");
  for (const auto& column : kJointColumns) {
    take(
        joint.read(column.name, shape),
        [&](PoseResult& p) -> double& { return p.joint.*column.member; }, column.unit);
  }
  for (std::size_t c = 0; c < scene.contacts.size(); ++c)
    take(
        contacts.read(scene.contacts[c].name, shape),
        [c](PoseResult& p) -> double& { return p.contacts[c].force; }, 1);
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
    take(
        ligaments.read(scene.ligaments[i].name, shape),
        [i](PoseResult& p) -> double& { return p.ligaments[i].force; }, 1);
  return sweeps;
}

}  // namespace

void write_laxity(const Hdf5Group& laxity, const Scene& scene, const LaxityResult& result) {
  std::vector<double> flexions, loads;
  for (const double flexion : scene.laxity->flexions) flexions.push_back(flexion / kDegree);
  const LoadDescription& load = scene.loads[scene.sweep->index];
  for (const double value : scene.sweep->values) loads.push_back(value * load.vector.norm());
  laxity.write("flexion", flexions, {flexions.size()}, "deg");
  laxity.write("scale", scene.sweep->values, {loads.size()}, "1");
  laxity.write("load", loads, {loads.size()}, load.moment ? "N mm" : "N");
  for (const bool cut : {false, true}) {
    std::vector<const SweepResult*> ours, reference;
    for (const LaxityCurve& curve : result.curves) {
      if (curve.cut != cut) continue;
      ours.push_back(&curve.ours);
      if (curve.reference) reference.push_back(&*curve.reference);
    }
    if (ours.empty()) continue;
    const Hdf5Group state = laxity.create(state_name(cut));
    write_curves(state.create("ours"), scene, ours);
    if (!reference.empty()) write_curves(state.create("reference"), scene, reference);
  }
}

LaxityResult read_laxity(const Hdf5Group& laxity, const Scene& scene) {
  if (!scene.laxity || !scene.sweep) laxity.fail("belongs to a scene without [laxity]");
  LaxityResult result;
  const std::vector<double>& flexions = scene.laxity->flexions;
  for (const bool cut : {false, true}) {
    if (!laxity.has(state_name(cut))) continue;
    const Hdf5Group state = laxity.open(state_name(cut));
    std::vector<SweepResult> ours = read_curves(state.open("ours"), scene, flexions.size());
    std::vector<SweepResult> reference;
    if (state.has("reference"))
      reference = read_curves(state.open("reference"), scene, flexions.size());
    for (std::size_t f = 0; f < flexions.size(); ++f) {
      LaxityCurve curve{flexions[f], cut, std::move(ours[f]), {}};
      if (!reference.empty()) curve.reference = std::move(reference[f]);
      result.curves.push_back(std::move(curve));
    }
  }
  return result;
}

}  // namespace condyle
