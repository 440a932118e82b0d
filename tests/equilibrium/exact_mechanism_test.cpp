/// The knee mechanism of Feikes et al. 2003: two spheres on two planes, three fibres of constant
/// length. With flexion prescribed six constraints leave no freedom, and the forces follow.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/math/degree.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle {
namespace {

const std::filesystem::path kFolder =
    std::filesystem::path(CONDYLE_SOURCE_DIR) / "../shared/published";

/// Rows of a comma-separated file below its heading.
std::vector<std::vector<std::string>> rows(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::vector<std::vector<std::string>> all;
  std::string line, cell;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    std::vector<std::string>& row = all.emplace_back();
    std::istringstream cells(line);
    while (std::getline(cells, cell, ',')) row.push_back(cell);
  }
  return all;
}

/// Axes of the data: x anterior, y superior, z lateral; both frames coincide in extension.
struct Mechanism {
  std::map<std::string, Eigen::Vector3d> points;
  Model model;

  explicit Mechanism(const std::vector<std::vector<std::string>>& table) {
    for (const auto& row : table)
      points[row[0]] = {std::stod(row[1]), std::stod(row[2]), std::stod(row[3])};
    JointFrames frames;  // lateral, anterior, proximal
    frames.X_F.R << 0, 1, 0, 0, 0, 1, 1, 0, 0;
    frames.X_T.R = frames.X_F.R;
    model.joint = frames;
    for (const char* name : {"ACL", "PCL", "MCL"}) {
      KinematicCondition fibre;
      fibre.kind = ConditionKind::kDistance;
      fibre.x_C = at(name, "_femur");
      fibre.s_D = at(name, "_tibia");
      fibre.value = (fibre.x_C - fibre.s_D).norm();
      add(name, fibre);
    }
    KinematicCondition flexion;
    flexion.kind = ConditionKind::kFlexion;
    flexion.frames = frames;
    add("flexion", flexion);
    for (const char* name : {"medial", "lateral"}) {
      ContactPair pair;
      pair.name = name;
      pair.mode = ContactMode::kClosed;
      pair.on_B = make_sphere(at(name, "_sphere_centre_femur"), radius(name), true);
      pair.on_A = make_plane(at(name, "_contact_tibia"), at(name, "_plane_normal"));
      model.pairs.push_back(pair);
    }
    Load load;
    load.vector = {30, -10, 20};
    load.at = {5, -150, 10};
    model.loads = {load};
    model.load_names = {"load"};
    model.length = 30;
  }
  [[nodiscard]] Eigen::Vector3d at(const std::string& name, const std::string& what) const {
    return points.at(name + what);
  }
  /// The sphere touches the plane in extension.
  [[nodiscard]] double radius(const std::string& name) const {
    return (at(name, "_sphere_centre_femur") - at(name, "_contact_tibia")).norm();
  }
  void add(const char* name, const KinematicCondition& condition) {
    model.conditions.push_back(condition);
    model.condition_names.emplace_back(name);
  }
};

class Feikes : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kFolder / "mechanism_feikes2003.csv"))
      GTEST_SKIP() << "no published mechanism beside the project";
  }
};

TEST_F(Feikes, PathMeetsAllConstraintsTo1em8) {
  const Mechanism mechanism(rows(kFolder / "mechanism_feikes2003.csv"));
  EquilibriumSolver solver(mechanism.model);
  const auto path = rows(kFolder / "feikes2003_mechanism_path.csv");
  ASSERT_GT(path.size(), 90u);
  for (const auto& row : path) {
    const double flexion = std::stod(row[0]);
    const PoseResult pose =
        solver.solve(condition_value(3).with(drive_of(solver.model()), flexion * kDegree));
    ASSERT_TRUE(pose.converged()) << flexion << ": " << pose.reason;
    for (int i = 0; i < 3; ++i) {
      const KinematicCondition& fibre = mechanism.model.conditions[static_cast<std::size_t>(i)];
      EXPECT_NEAR((pose.X_BA * fibre.s_D - fibre.x_C).norm(), fibre.value, 1e-10);
    }
    const RigidTransform X_tibia = pose.X_BA.inverse();
    for (const char* name : {"medial", "lateral"}) {
      const Eigen::Vector3d center = X_tibia * mechanism.at(name, "_sphere_centre_femur");
      EXPECT_NEAR(center.y() + 20.2, mechanism.radius(name), 1e-10);
    }
    EXPECT_NEAR(pose.joint.flexion, flexion * kDegree, 1e-12);
    // Six constraints to 1e-10 leave the pose no more than 1e-8 mm; the table has six decimals.
    const Eigen::Vector3d expected(std::stod(row[3]), std::stod(row[4]), std::stod(row[5]));
    EXPECT_LT((pose.X_BA.p - expected).norm(), 1.5e-6) << flexion;
    EXPECT_NEAR(pose.joint.internal_rotation / kDegree, std::stod(row[2]), 1e-6) << flexion;
    EXPECT_EQ(pose.lowest_stiffness, INFINITY);
  }
}

// Virtual work: what the flexion moment does along the path is what the load does.
TEST_F(Feikes, TheFlexionMomentIsTheWorkOfTheLoadPerRadian) {
  const Mechanism mechanism(rows(kFolder / "mechanism_feikes2003.csv"));
  EquilibriumSolver solver(mechanism.model);
  const Load& load = mechanism.model.loads[0];
  for (const double flexion : {20.0, 50.0, 80.0}) {
    const auto pose_at = [&](double angle) {
      return solver.solve(condition_value(3).with(drive_of(solver.model()), angle));
    };
    constexpr double kStep = 1e-4;
    const PoseResult before = pose_at(flexion * kDegree - kStep), pose = pose_at(flexion * kDegree),
                     after = pose_at(flexion * kDegree + kStep);
    ASSERT_TRUE(before.converged() && pose.converged() && after.converged());
    const Eigen::Vector3d way = after.X_BA * load.at - before.X_BA * load.at;
    EXPECT_NEAR(pose.conditions[3].multiplier, load.vector.dot(way) / (2 * kStep), 1e-3) << flexion;
  }
}

}  // namespace
}  // namespace condyle
