/// Other phantom knees: shapes, scenes and motion.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/scene_file/read_study.h"
#include "phantom/exact_motion.h"
#include "phantom/population.h"
#include "phantom/population_scene.h"
#include "phantom/write_knee.h"

namespace condyle::phantom {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
namespace fs = std::filesystem;

Scene shipped_scene() {
  return read_scene(fs::path(CONDYLE_SOURCE_DIR) / "data/phantom/knee.toml");
}

/// Points near insertions and contacts, on one bone of a knee.
std::vector<Vector3d> places_of(Bone bone, const PhantomParameters& knee) {
  std::vector<Vector3d> places;
  for (const LigamentDescription& ligament : shipped_scene().ligaments)
    for (const Attachment& end : ligament.ends)
      if ((end.body == 0) == (bone == Bone::kFemur)) places.push_back(sized(bone, end.at, knee));
  return places;
}

class PhantomPopulation : public testing::Test {
 protected:
  PhantomPopulation()
      : folder_(fs::temp_directory_path() / ("condyle_population_" + std::to_string(::getpid()))) {
    fs::create_directory(folder_);
  }
  ~PhantomPopulation() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  /// The shipped scene carried to a knee, with coarse meshes, which the sweeps here do not use.
  Scene carried(const PhantomParameters& knee) const {
    for (const Bone bone : {Bone::kFemur, Bone::kTibia})
      write_bone(folder_ / fmt::format("K_{}.stl", bone_name(bone)), bone,
                 {.resolution = 6, .roughness = {}, .split = 0}, knee);
    std::ofstream(folder_ / "K.toml") << carried_scene_text(shipped_scene(), knee, "K");
    return read_scene(folder_ / "K.toml");
  }

  fs::path folder_;
};

TEST_F(PhantomPopulation, TheShippedPhantomIsTheKneeOfNoChange) {
  std::vector<double> measures;
  for (const MeasureSpread& spread : measure_spreads())
    measures.push_back(std::string(spread.unit) == "1" ? 1.0 : spread.mean);
  const PhantomParameters knee = with_closed_compartments(with_measures(measures));
  EXPECT_NEAR(knee.tibia.rise, 0, 2e-3);  // slopes are told in whole degrees
  for (const Bone bone : {Bone::kFemur, Bone::kTibia})
    for (const Vector3d& p : places_of(bone, kShippedPhantom))
      EXPECT_NEAR(shape(bone, p, knee), shape(bone, p), 5e-3) << p.transpose();
  const Scene scene = shipped_scene();
  for (const LigamentDescription& ligament : scene.ligaments)
    EXPECT_LT(
        (carried_point(Bone::kFemur, ligament.ends[0].at, kShippedPhantom) - ligament.ends[0].at)
            .norm(),
        1e-11);
}

TEST_F(PhantomPopulation, DerivativesOfAnyKneeAgreeWithDifferences) {
  const PhantomParameters knee = population_knee(3, 8).parameters;
  const double h = 1e-5;
  for (const Bone bone : {Bone::kFemur, Bone::kTibia})
    for (const Vector3d& p : places_of(bone, knee)) {
      const ShapeValue s = shape_derivatives(bone, p, knee);
      Vector3d g;
      Matrix3d H;
      for (int a = 0; a < 3; ++a) {
        const Vector3d step = h * Vector3d::Unit(a);
        g[a] = (shape(bone, p + step, knee) - shape(bone, p - step, knee)) / (2 * h);
        H.col(a) = (shape_derivatives(bone, p + step, knee).g -
                    shape_derivatives(bone, p - step, knee).g) /
                   (2 * h);
      }
      EXPECT_LT((s.g - g).norm(), 1e-8);
      EXPECT_LT((s.h - H).norm(), 1e-7);
      // The curvature is the change of the normal.
      const SurfacePoint at = surface_point(bone, p, knee);
      const SurfacePoint beside = surface_point(bone, at.c + 1e-4 * at.n.unitOrthogonal(), knee);
      EXPECT_LT((beside.n - at.n + at.K * (beside.c - at.c)).norm(), 2e-8);
    }
}

TEST_F(PhantomPopulation, RadiiComeOutAsTheParametersSay) {
  PhantomParameters knee;
  knee.femur.size = {.depth = 1.1, .width = 0.95};
  knee.femur.medial.posterior = 23;
  // The medial condyle's back, where it is a circle in both sections (docs/phantom.md).
  const SurfacePoint back = surface_point(Bone::kFemur, {-1.1 * 23, 0, -0.95 * 25}, knee);
  const Vector3d t = Vector3d(-back.n.y(), back.n.x(), 0).normalized();
  EXPECT_NEAR(-1 / t.dot(back.K * t), 1.1 * 23, 0.5);
  const Vector3d u = back.n.cross(t);
  EXPECT_NEAR(-1 / u.dot(back.K * u), 0.95 * 0.95 / 1.1 * 20, 0.5);
}

TEST_F(PhantomPopulation, KneesDifferAndTheSeedRepeatsThem) {
  std::set<std::vector<double>> knees;
  for (std::uint64_t number = 1; number <= 20; ++number)
    knees.insert(population_knee(1, number).measures);
  EXPECT_EQ(knees.size(), 20U);
  EXPECT_EQ(population_knee(1, 7).measures, population_knee(1, 7).measures);
  EXPECT_NE(population_knee(1, 7).measures, population_knee(2, 7).measures);
}

TEST_F(PhantomPopulation, CompartmentsAreClosedAsThoseOfTheShippedPhantom) {
  for (std::uint64_t number = 1; number <= 5; ++number) {
    const PhantomParameters knee = population_knee(1, number).parameters;
    for (const int side : {-1, 1})
      EXPECT_NEAR(start_gap(knee, side), knee.femur.size.depth * start_gap(kShippedPhantom, side),
                  1e-9);
  }
}

TEST_F(PhantomPopulation, InsertionsKeepTheirDepth) {
  const Scene shipped = shipped_scene();
  const PhantomParameters knee = population_knee(1, 4).parameters;
  const Scene scene = carried(knee);
  const auto depth = [](Bone bone, const Vector3d& p, const PhantomParameters& of) {
    const Vector3d c = project(bone, p, of);
    return (p - c).dot(normal(bone, c, of));
  };
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
    for (std::size_t e = 0; e < 2; ++e) {
      const Attachment &end = scene.ligaments[i].ends[e], &was = shipped.ligaments[i].ends[e];
      const Bone bone = end.body == 0 ? Bone::kFemur : Bone::kTibia;
      const double size = end.body == 0 ? knee.femur.size.depth : knee.tibia.size.depth;
      EXPECT_NEAR(depth(bone, end.at, knee), size * depth(bone, was.at, kShippedPhantom), 1e-6)
          << scene.ligaments[i].name;
      EXPECT_GT((end.at - was.at).norm(), 1e-3);
      EXPECT_DOUBLE_EQ(*scene.ligaments[i].reference_strain,
                       *shipped.ligaments[i].reference_strain);
    }
}

// Strains, forces and directions do not know the size: with the same stiffnesses in N per strain and the
// same loads, a knee that is larger as a whole moves as the smaller one does, lengths in proportion.
TEST_F(PhantomPopulation, AKneeSizedAsAWholeMovesInProportion) {
  const double s = 1.25;
  PhantomParameters knee;
  knee.femur.size = knee.tibia.size = {.depth = s, .width = s};
  Scene small = shipped_scene(), large = carried(with_closed_compartments(knee));
  const SweepResult a = sweep(small, exact_surfaces(small)),
                    b = sweep(large, exact_surfaces(large, with_closed_compartments(knee)));
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    const PoseResult &p = a.poses[i], &q = b.poses[i];
    ASSERT_TRUE(p.converged() && q.converged()) << i;
    EXPECT_NEAR(q.joint.internal_rotation, p.joint.internal_rotation, 1e-6) << i;
    EXPECT_NEAR(q.joint.adduction, p.joint.adduction, 1e-6) << i;
    EXPECT_NEAR(q.joint.anterior_drawer, s * p.joint.anterior_drawer, 1e-5) << i;
    EXPECT_NEAR(q.joint.lateral_shift, s * p.joint.lateral_shift, 1e-5) << i;
    EXPECT_NEAR(q.joint.distraction, s * p.joint.distraction, 1e-5) << i;
    for (std::size_t c = 0; c < 2; ++c)
      EXPECT_NEAR(q.contacts[c].force, p.contacts[c].force, 1e-3) << i;
    for (std::size_t l = 0; l < p.ligaments.size(); ++l)
      EXPECT_NEAR(q.ligaments[l].force, p.ligaments[l].force, 1e-3) << i;
  }
}

TEST_F(PhantomPopulation, WritesKneesAndAStudyOfThem) {
  const KneeMeshes coarse{.resolution = 3, .roughness = {.rms = 0}, .split = 0};
  write_population(folder_, shipped_scene(), 2, 5, coarse);
  for (const char* name : {"P001", "P002"}) {
    const Scene scene = read_scene(folder_ / fmt::format("{}.toml", name));
    EXPECT_EQ(scene.title, fmt::format("Phantom, right knee {}", name));
    for (const BodyDescription& body : scene.bodies)
      EXPECT_EQ(body.mesh->path.filename().string(), fmt::format("{}_{}.stl", name, body.name));
  }
  EXPECT_TRUE(fs::exists(folder_ / "population.csv"));
  const ReadStudy study = read_study(folder_ / "study.toml");
  EXPECT_EQ(study.scenes.size(), 2U);
}

TEST_F(PhantomPopulation, RefusesAFolderThatIsNotThere) {
  EXPECT_THROW(write_population(folder_ / "absent", shipped_scene(), 1, 1,
                                {.resolution = 6, .roughness = {}, .split = 0}),
               InputError);
}

}  // namespace
}  // namespace condyle::phantom
