/// A ball pressed into a corner: its centre is one radius from each wall, and each wall carries the
/// component of the load along its normal.

#include <condyle/equilibrium/equilibrium_solver.h>
#include <condyle/surface/exact_surfaces.h>
#include <condyle/version.h>

#include <cstdio>

int main() {
  using namespace condyle;
  const Eigen::Vector3d load(-3, -4, -5);  // [N]
  constexpr double kRadius = 10;           // [mm]
  Model model;
  for (int axis = 0; axis < 3; ++axis) {
    ContactPair wall;
    wall.name = std::string("wall ") + "xyz"[axis];
    wall.on_B = make_plane(Eigen::Vector3d::Zero(), Eigen::Vector3d::Unit(axis));
    wall.on_A = make_sphere(Eigen::Vector3d::Zero(), kRadius, true);
    model.pairs.push_back(wall);
    KinematicCondition held;  // a ball may turn freely
    held.kind = ConditionKind::kRotation;
    held.cardan_axis = axis;
    model.conditions.push_back(held);
    model.condition_names.push_back(std::string("turn about ") + "xyz"[axis]);
  }
  Load push;
  push.vector = load;
  model.loads = {push};
  model.load_names = {"push"};
  model.start.p = {12, 13, 11};
  const PoseResult pose = EquilibriumSolver(model).solve();
  double off = (pose.X_BA.p - Eigen::Vector3d::Constant(kRadius)).norm() / kRadius;
  for (int axis = 0; axis < 3; ++axis)
    off = std::max(off, std::abs(pose.contacts[axis].force + load[axis]) / load.norm());
  std::printf("condyle %s: %s, off by %.1e\n", CONDYLE_VERSION,
              pose.converged() ? "converged" : pose.reason.c_str(), off);
  return pose.converged() && off < 1e-12 ? 0 : 1;
}
