/// The phantom moves like a knee: the shipped scene on the exact surfaces, no fit between. The
/// figures it is held to are those of docs/phantom.md, "How it moves".

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numeric>

#include "condyle/equilibrium/sweep.h"
#include "condyle/scene_file/read_scene.h"
#include "phantom/exact_motion.h"

namespace condyle::phantom {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

class PhantomMotion : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scene_ =
        read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data" / "phantom" / "knee.toml");
    sweep_ = sweep(scene_, exact_surfaces(scene_));
  }

  static const PoseResult& at(int degrees) { return sweep_.poses[degrees / 5]; }

  /// Sum of the forces of all ligaments whose name holds `part` [N].
  static double force(int degrees, const std::string& part) {
    double sum = 0;
    for (std::size_t i = 0; i < scene_.ligaments.size(); ++i)
      if (scene_.ligaments[i].name.find(part) != std::string::npos)
        sum += at(degrees).ligaments[i].force;
    return sum;
  }

  /// x of a contact point on the tibia [mm]; contacts are medial, lateral.
  static double contact_x(int degrees, int contact) {
    return at(degrees).contacts[contact].points.front().point_moving.x();
  }

  static inline Scene scene_;
  static inline SweepResult sweep_;
};

TEST_F(PhantomMotion, EveryPoseConvergesWithBothContactsClosed) {
  ASSERT_EQ(sweep_.poses.size(), 25U);
  for (const PoseResult& pose : sweep_.poses) {
    EXPECT_TRUE(pose.converged()) << pose.value * kDegrees << " deg: " << pose.reason;
    for (const ContactResult& contact : pose.contacts) {
      EXPECT_TRUE(contact.closed);
      EXPECT_GT(contact.force, 20);  // the smallest is 43 N, lateral, at mid-flexion
      EXPECT_LT(contact.force, 600);
    }
    for (const LigamentResult& ligament : pose.ligaments) EXPECT_LT(ligament.force, 150);
  }
}

TEST_F(PhantomMotion, TibiaRotatesInwardsWithFlexion) {
  for (int d = 0; d < 120; d += 5)
    EXPECT_GT(at(d + 5).joint.internal_rotation, at(d).joint.internal_rotation) << d;
  const double rotation =
      (at(120).joint.internal_rotation - at(0).joint.internal_rotation) * kDegrees;
  EXPECT_NEAR(rotation, 20, 3);  // 20 degrees from extension to 120 [Johal 2005]
  // at least a third of it in the first 30 degrees [Qi 2013: sharp rise, then slower]
  EXPECT_GT((at(30).joint.internal_rotation - at(0).joint.internal_rotation) * kDegrees,
            rotation / 3);
}

TEST_F(PhantomMotion, LateralContactMovesBackMoreThanMedial) {
  const double medial = contact_x(0, 0) - contact_x(120, 0),
               lateral = contact_x(0, 1) - contact_x(120, 1);
  EXPECT_GT(medial, 0);
  EXPECT_GT(lateral, medial + 3);
  // from 30 to 120 degrees the medial contact hardly moves [Freeman and Pinskerova 2005]
  EXPECT_LT(contact_x(30, 0) - contact_x(120, 0), 7);
}

TEST_F(PhantomMotion, CruciatesTakeTurns) {
  EXPECT_GT(force(0, "ACL"), 60);
  EXPECT_GT(force(0, "ACL"), 2 * force(30, "ACL"));
  EXPECT_LT(force(0, "PCL"), 1e-9);
  EXPECT_LT(force(30, "PCL"), 5);
  EXPECT_GT(force(90, "PCL"), 40);
  EXPECT_GT(force(100, "PCL"), force(100, "ACL"));
}

TEST_F(PhantomMotion, CollateralsAndCapsuleSlackenAfterExtension) {
  EXPECT_GT(force(0, "LCL"), 30);
  EXPECT_LT(force(30, "LCL"), 1);
  EXPECT_GT(force(0, "CAP"), 30);
  EXPECT_LT(force(15, "CAP"), 1);
}

}  // namespace
}  // namespace condyle::phantom
