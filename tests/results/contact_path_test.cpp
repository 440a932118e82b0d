/// Which points of contact may be joined by a line.

#include "condyle/results/contact_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace condyle {
namespace {

using Path = std::vector<std::vector<std::size_t>>;

/// One contact at these places along x [mm], a pose for each degree.
SweepResult along(const std::vector<double>& places) {
  SweepResult sweep;
  for (const double x : places) {
    ContactPointResult point;
    point.force = 1;
    point.point_ground = point.point_moving = {x, 0, 0};
    PoseResult pose;
    pose.status = PoseStatus::kConverged;
    pose.value = static_cast<double>(sweep.poses.size());
    pose.contacts.resize(1);
    pose.contacts[0].closed = true;
    pose.contacts[0].points = {point};
    sweep.poses.push_back(pose);
  }
  return sweep;
}

TEST(ContactPath, FollowsAContactThatRolls) {
  EXPECT_EQ(contact_path(along({0, 1, 2, 3, 4}), 0), (Path{{0, 1, 2, 3, 4}}));
  // It may gather speed: 0.5, 1, 2, 4, 7 mm.
  EXPECT_EQ(contact_path(along({0, 0.5, 1.5, 3.5, 7.5, 14.5}), 0).size(), 1U);
}

TEST(ContactPath, BreaksWhereAStepIsFarLongerThanThoseAroundIt) {
  EXPECT_EQ(contact_path(along({0, 1, 2, 14, 15, 16}), 0), (Path{{0, 1, 2}, {3, 4, 5}}));
  EXPECT_EQ(contact_path(along({0, 1, 13, 1.5, 2.5, 3.5}), 0), (Path{{0, 1}, {2}, {3, 4, 5}}));
  EXPECT_EQ(contact_path(along({0, 0.1, 2.6, 2.7}), 0).size(), 1U) << "the dots of 2.5 mm touch";
  EXPECT_EQ(contact_path(along({0, 30}), 0).size(), 2U) << "whatever lies around";
}

TEST(ContactPath, AJumpOnOneBodyIsAJump) {
  SweepResult sweep = along({0, 1, 2, 3, 4, 5});
  for (std::size_t i = 3; i < 6; ++i) sweep.poses[i].contacts[0].points[0].point_moving.x() += 12;
  EXPECT_EQ(contact_path(sweep, 0), (Path{{0, 1, 2}, {3, 4, 5}}));
}

TEST(ContactPath, ALongStepOverALongWayIsNone) {
  SweepResult sweep = along({0, 1, 2, 10, 11, 12});
  for (std::size_t i = 3; i < 6; ++i) sweep.poses[i].value += 7;  // 8 mm over 8 degrees
  EXPECT_EQ(contact_path(sweep, 0).size(), 1U);
}

TEST(ContactPath, BreaksAtMissingPosesAndOpenContacts) {
  SweepResult sweep = along({0, 1, 2, 3, 4});
  sweep.poses[2].contacts[0].closed = false;
  EXPECT_EQ(contact_path(sweep, 0), (Path{{0, 1}, {3, 4}}));
  for (const PoseStatus status : {PoseStatus::kSingular, PoseStatus::kLeftPatch}) {
    sweep = along({0, 1, 2, 3, 4});
    sweep.poses[1].status = status;
    EXPECT_EQ(contact_path(sweep, 0), (Path{{0}, {2, 3, 4}})) << name(status);
  }
}

TEST(ContactPath, BreaksWhereAnEventSaysSo) {
  SweepResult sweep = along({0, 1, 2, 3, 4});
  sweep.events = {{1.5, EventKind::kJump, 0}};
  EXPECT_EQ(contact_path(sweep, 0), (Path{{0, 1}, {2, 3, 4}}));
  sweep.events = {{1.5, EventKind::kJump, 1}};
  EXPECT_EQ(contact_path(sweep, 0).size(), 1U) << "of another contact";
  sweep.events = {{1.5, EventKind::kLimitPoint, -1}};
  EXPECT_EQ(contact_path(sweep, 0).size(), 2U) << "the joint snaps through";
  sweep.events = {{2.3, EventKind::kOpening, 0}, {2.6, EventKind::kClosing, 0}};
  EXPECT_EQ(contact_path(sweep, 0), (Path{{0, 1, 2}, {3, 4}}));
  sweep.events = {{2.3, EventKind::kClosing, 0}};
  EXPECT_EQ(contact_path(sweep, 0).size(), 1U) << "a second point begins to carry";
}

TEST(ContactPath, BreaksWhereAnotherPointComesToCarryMost) {
  SweepResult sweep = along({0, 1, 2, 3, 4, 5});
  for (std::size_t i = 1; i < 5; ++i) {  // a second point 4 mm away, stronger at two poses
    std::vector<ContactPointResult>& points = sweep.poses[i].contacts[0].points;
    points.push_back(points[0]);
    points[1].point_ground.y() = points[1].point_moving.y() = 4;
    points[1].force = i == 2 || i == 3 ? 2 : 0.5;
  }
  EXPECT_EQ(contact_path(sweep, 0), (Path{{0, 1}, {2, 3}, {4, 5}}));
}

TEST(ContactPath, KnowsWhatIsJoined) {
  const Path path = {{0, 1, 2}, {4, 5}};
  EXPECT_TRUE(joined(path, 0, 2));
  EXPECT_TRUE(joined(path, 5, 4));
  EXPECT_FALSE(joined(path, 2, 4));
  EXPECT_FALSE(joined(path, 2, 3));
}

/// Load goes over from a point to its neighbour 5 mm further, a tenth at each degree.
SweepResult handed_over() {
  SweepResult sweep = along(std::vector<double>(11, 0.0));
  for (std::size_t i = 0; i < sweep.poses.size(); ++i) {
    ContactResult& contact = sweep.poses[i].contacts[0];
    contact.force = 100;
    contact.points.push_back(contact.points.front());
    contact.points[0].force = 100 - 10 * static_cast<double>(i);
    contact.points[1].force = 10 * static_cast<double>(i);
    contact.points[1].point_ground = contact.points[1].point_moving = {5, 0, 0};
  }
  return sweep;
}

TEST(ContactPath, TheResultantMovesOnWhereAnotherPointComesToCarryMost) {
  EXPECT_EQ(contact_path(handed_over(), 0).size(), 2U);
  EXPECT_EQ(resultant_path(handed_over(), 0).size(), 1U);
}

TEST(ContactPath, TheResultantIsBrokenWhereItJumpsOrIsLost) {
  SweepResult sweep = handed_over();
  for (std::size_t i = 6; i < sweep.poses.size(); ++i)
    for (ContactPointResult& point : sweep.poses[i].contacts[0].points) point.point_ground.y() += 9;
  EXPECT_EQ(resultant_path(sweep, 0).size(), 2U);
  sweep = handed_over();
  sweep.poses[4].status = PoseStatus::kIterationLimit;
  EXPECT_EQ(resultant_path(sweep, 0), (Path{{0, 1, 2, 3}, {5, 6, 7, 8, 9, 10}}));
}

}  // namespace
}  // namespace condyle
