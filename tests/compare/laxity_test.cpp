#include "condyle/compare/laxity.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "condyle/equilibrium/sweep.h"
#include "condyle/input_error.h"
#include "condyle/math/degree.h"
#include "condyle/math/rotation.h"
#include "condyle/results/run_file.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "scene/small_scene.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

constexpr const char* kDrawer = CONDYLE_SOURCE_DIR "/data/wismans-type/drawer.toml";

// A dead load stands in the ground frame, in which the tibia may be turned at the start.
TEST(Laxity, TheCoordinateOfADeadLoadIsSeenFromTheBone) {
  Scene scene = read_scene(kDrawer);
  scene.loads[static_cast<std::size_t>(scene.sweep->index)].follows_body = false;
  EXPECT_EQ(loaded_coordinate(scene), 4U);
  const Eigen::Matrix3d turn = exp_rotation({0, 0, std::numbers::pi / 2});
  AnatomicalFrame& tibia = scene.joint->tibia;
  for (Eigen::Vector3d* v : {&tibia.origin, &tibia.lateral, &tibia.anterior, &tibia.proximal})
    *v = turn * *v;
  scene.bodies[static_cast<std::size_t>(tibia.body)].start_rotation = {0, 0, -std::numbers::pi / 2};
  EXPECT_EQ(loaded_coordinate(scene), 4U);
}

// A force aside at the ankle, 313 mm below the plateau, is a test of varus and valgus; one at the tibial tuberosity draws.
TEST(Laxity, AForceFarFromTheJointTurnsIt) {
  Scene scene = read_scene(kDrawer);
  LoadDescription& load = scene.loads[static_cast<std::size_t>(scene.sweep->index)];
  const AnatomicalFrame& tibia = scene.joint->tibia;
  const auto along = [&](const Eigen::Vector3d& way, double below) {
    load.vector = 30 * way;
    load.at = tibia.origin - below * tibia.proximal;
    return loaded_coordinate(scene);
  };
  EXPECT_EQ(along(tibia.lateral, 313), 1U);
  EXPECT_EQ(along(tibia.lateral, 50), 3U);
  EXPECT_EQ(along(tibia.anterior, 313), 4U) << "flexion is held";
  EXPECT_EQ(along(tibia.anterior, 50), 4U);
}

// A dead load keeps its direction while the knee bends.
TEST(Laxity, ADeadLoadThatTurnsIntoAnotherCoordinateIsTold) {
  Scene scene = read_scene(kDrawer);
  scene.loads[static_cast<std::size_t>(scene.sweep->index)].follows_body = false;
  scene.laxity->cut.clear();
  scene.laxity->flexions = {0, 90 * kDegree};
  const LaxityResult result = test_laxity(scene, fit_surfaces(scene));
  const std::vector<std::string> lines = laxity_lines(scene, result);
  EXPECT_EQ(lines.back(),
            "at 90 degrees drawer acts on distraction and not on anterior drawer: it keeps its "
            "direction in space");
  scene.laxity->flexions = {0, 20 * kDegree};
  EXPECT_EQ(laxity_lines(scene, test_laxity(scene, fit_surfaces(scene))).back().substr(0, 6),
            "intact");
}

TEST(Laxity, GoesBySteps) {
  Scene scene = read_scene(kDrawer);
  EXPECT_NO_THROW(check_laxity_scene(scene));
  scene.sweep->arc_length = true;
  EXPECT_THROW(check_laxity_scene(scene), InputError);
}

TEST(Laxity, GrowsWhenTheCruciateIsCut) {
  const Scene scene = read_scene(kDrawer);
  EXPECT_EQ(loaded_coordinate(scene), 4U);  // a drawer force draws
  const LaxityResult result = test_laxity(scene, fit_surfaces(scene));
  ASSERT_EQ(result.curves.size(), 8U);
  for (std::size_t f = 0; f < 4; ++f) {
    const LaxityCurve &intact = result.curves[f], &cut = result.curves[f + 4];
    EXPECT_FALSE(intact.cut);
    EXPECT_TRUE(cut.cut);
    EXPECT_NEAR(intact.flexion, static_cast<double>(30 * f) * kDegree, 1e-12);
    EXPECT_EQ(intact.ours.count_converged(), 21);
    EXPECT_EQ(cut.ours.count_converged(), 21);
    EXPECT_GT(laxity_of(scene, cut.ours), 1.5 * laxity_of(scene, intact.ours));
    ASSERT_TRUE(intact.reference && cut.reference);
    EXPECT_GT(laxity_of(scene, *cut.reference), 1.2 * laxity_of(scene, *intact.reference));
    // The cruciate is what a cut knee lacks.
    EXPECT_EQ(cut.ours.poses.back().ligaments[0].force, 0);
    EXPECT_GT(intact.ours.poses.back().ligaments[0].force, 0);
  }
}

TEST(Laxity, ALoadIsSweptLikeAnAngle) {
  // The same curve by the sweep that the scene describes, at its own flexion of 0.
  const Scene scene = read_scene(kDrawer);
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const SweepResult swept = sweep(scene, surfaces);
  const LaxityResult result = test_laxity(scene, surfaces);
  ASSERT_EQ(swept.poses.size(), 21U);
  for (std::size_t i = 0; i < swept.poses.size(); ++i) {
    ASSERT_TRUE(swept.poses[i].converged());
    EXPECT_LT((swept.poses[i].X_BA.p - result.curves[0].ours.poses[i].X_BA.p).norm(), 1e-9);
  }
  const std::vector<double> drawn = displacements(scene, swept);
  EXPECT_NEAR(drawn[10], 0, 1e-12);
  EXPECT_LT(drawn.front(), 0);
  EXPECT_GT(drawn.back(), 0);
}

// A load says how large it is by its vector or by its scale; the test is the same, and takes as long.
TEST(Laxity, DoesNotDependOnHowTheLoadIsWritten) {
  Scene scene = read_scene(kDrawer);
  scene.laxity->flexions = {30 * kDegree};
  const auto last = [](const Scene& s) {
    return test_laxity(s, fit_surfaces(s)).curves[0].ours.poses.back();
  };
  const PoseResult expected = last(scene);
  constexpr double kFactor = 1e12;
  scene.loads[scene.sweep->index].vector /= kFactor;
  for (double& value : scene.sweep->values) value *= kFactor;
  const PoseResult same = last(scene);
  ASSERT_TRUE(same.converged());
  EXPECT_LT((same.X_BA.p - expected.X_BA.p).norm(), 1e-9);
}

// On layers the knee is laxer; four times as stiff they leave half of that.
TEST(Laxity, OfLayersTendsToTheRigidOne) {
  Scene scene = read_scene(kDrawer);
  scene.laxity->flexions = {30 * kDegree};
  const auto laxities = [](const Scene& s) {
    std::array<double, 2> found{};
    const LaxityResult result = test_laxity(s, fit_surfaces(s));
    for (const LaxityCurve& curve : result.curves) {
      EXPECT_EQ(curve.ours.count_converged(), static_cast<int>(curve.ours.poses.size()));
      found[curve.cut ? 1 : 0] = laxity_of(s, curve.ours);
    }
    return found;
  };
  const auto on_layers = [&](double modulus) {
    for (SurfaceDescription& surface : scene.surfaces)
      surface.elastic = ElasticSurface{modulus, 0.45, 3};
    LayerOptions options;
    options.tolerance = 1e-4;
    for (ContactDescription& contact : scene.contacts) contact.layer = options;
    return laxities(scene);
  };
  const std::array<double, 2> rigid = laxities(scene), soft = on_layers(250),
                              stiff = on_layers(1000);
  for (const std::size_t knee : {0, 1}) {
    EXPECT_GT(std::abs(soft[knee] - rigid[knee]), 0.02);
    EXPECT_NEAR((stiff[knee] - rigid[knee]) / (soft[knee] - rigid[knee]), 0.5, 0.1) << knee;
  }
}

TEST(Laxity, GoesThroughAFileUnchanged) {
  Scene scene = read_scene(kDrawer);
  LaxityResult result = test_laxity(scene, fit_surfaces(scene));
  result.curves[5].ours.poses[3].status = PoseStatus::kNoEquilibrium;
  const std::filesystem::path file = test::fresh_folder("condyle_laxity") / "lax.h5";
  condyle::Run run{scene, {}, {}, {}};
  run.study = std::make_shared<const LaxityResult>(result);
  write_run(file, run);
  const condyle::Run back = read_run(file);
  ASSERT_TRUE(back.laxity() != nullptr);
  ASSERT_EQ(back.laxity()->curves.size(), 8U);
  for (std::size_t c = 0; c < 8; ++c) {
    const LaxityCurve &a = result.curves[c], &b = back.laxity()->curves[c];
    EXPECT_EQ(b.cut, a.cut);
    EXPECT_EQ(b.flexion, a.flexion);
    EXPECT_EQ(b.ours.poses[20].joint.anterior_drawer, a.ours.poses[20].joint.anterior_drawer);
    EXPECT_NEAR(laxity_of(scene, *b.reference), laxity_of(scene, *a.reference), 1e-12);
  }
  EXPECT_EQ(back.laxity()->curves[5].ours.poses[3].status, PoseStatus::kNoEquilibrium);
  EXPECT_TRUE(std::isnan(displacements(scene, back.laxity()->curves[5].ours)[3]));
}

std::string message_about_laxity(const std::string& laxity) {
  const std::string load = with(kSmallScene, "vary = \"bend\"\nfrom = 0\nto = 120\nstep = 5",
                                "vary = \"weight.scale\"\nvalues = [0, 1]");
  try {
    (void)parse_scene(load + laxity, "knee.toml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Laxity, NamesWhatIsWrongInItsTable) {
  EXPECT_EQ(message_about_laxity("[laxity]\nflexion = [0, 30]\ncut = [\"aACL\"]\n"), "no error");
  EXPECT_EQ(message_about_laxity("[laxity]\ncut = []\n"),
            "knee.toml:60: [laxity]: flexion is missing, expected angles [f1, f2, ...]");
  EXPECT_EQ(message_about_laxity("[laxity]\nflexion = []\n"),
            "knee.toml:61: [laxity]: flexion = [], expected angles [f1, f2, ...]");
  EXPECT_EQ(
      message_about_laxity("[laxity]\nflexion = [0]\ncut = [\"ACL\"]\n"),
      "knee.toml:62: [laxity]: cut = \"ACL\", expected the name of a ligament: \"aACL\"; did you "
      "mean \"aACL\"?");
  EXPECT_EQ(message_about_laxity("[laxity]\nflexion = [0]\ncut = [\"aACL\", \"aACL\"]\n"),
            "knee.toml:62: [laxity]: cut = \"aACL\", expected each ligament once");
  EXPECT_EQ(message_about_laxity("[laxity]\nflexion = [30, 0, 30]\n"),
            "knee.toml:61: [laxity]: flexion = [30, 0, 30], expected each angle once");
  EXPECT_EQ(message_about_laxity("[laxity]\nflexion = [0]\ncuts = []\n"),
            "knee.toml:62: [laxity]: unknown key cuts = [], did you mean \"cut\"?");
}

TEST(Laxity, NeedsALoadAlongACoordinateThatIsFree) {
  Scene scene = read_scene(kDrawer);
  LoadDescription& load = scene.loads[scene.sweep->index];
  load.moment = load.follows_body = true;
  load.vector = 1000 * scene.joint->tibia.lateral;
  load.body = scene.joint->tibia.body;
  try {
    check_laxity_scene(scene);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("acts along flexion, which condition "),
              std::string::npos)
        << error.what();
  }
}

// What a load that comes back to its first value says is a curve; from first to last is nothing.
TEST(Laxity, OfALoadThatComesBackThereIsNone) {
  Scene scene = read_scene(kDrawer);
  scene.sweep->values = {0, 1, 0};
  scene.laxity->flexions = {0};
  scene.laxity->cut.clear();
  LaxityResult result = test_laxity(scene, fit_surfaces(scene));
  EXPECT_TRUE(std::isnan(laxity_of(scene, result.curves[0].ours)));
  EXPECT_EQ(laxity_lines(scene, result)[2],
            "intact    0                  -           -       3 of 3");
  result.curves[0].ours.poses.pop_back();
  result.curves[0].reference->poses[1].status = PoseStatus::kDiverged;
  EXPECT_TRUE(laxity_lines(scene, result)[2].ends_with("2 of 2, reference 2 of 3"))
      << laxity_lines(scene, result)[2];
}

TEST(Laxity, NeedsALoadThatIsSwept) {
  try {
    (void)parse_scene(kSmallScene + "[laxity]\nflexion = [0]\n", "knee.toml");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "knee.toml:62: [laxity]: needs a [sweep] with vary = \"NAME.scale\", the load that "
              "pulls");
  }
}

}  // namespace
}  // namespace condyle
