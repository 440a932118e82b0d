/// What is right passes, on every scene and specimen; what is wrong is found and named.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <functional>
#include <sstream>

#include "condyle/input_error.h"
#include "condyle/math/rotation.h"
#include "condyle/results/digest.h"
#include "condyle/results/line_file.h"
#include "condyle/results/run_columns.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/verify/verify.h"
#include "support/mesh_shapes.h"
#include "verify/computed_run.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::computed_run;
using test::kSource;
using test::kSpecimens;
using test::phantom_run;

#define EXPECT_WORDS(text, words) EXPECT_NE((text).find(words), std::string::npos) << (text)

void expect_verified(const Run& run, const std::string& name, bool meshes = true) {
  VerifyOptions options;
  options.meshes = meshes;
  const Verification verification = verify_run(run, options);
  for (const Fault& fault : verification.faults) ADD_FAILURE() << name << ": " << fault.text;
}

std::vector<std::filesystem::path> scenes_in(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(kSource / folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

TEST(VerifyRun, FindsNothingWrongInShippedScenes) {
  for (const char* folder : {"data/dortmans", "data/hard", "data/wismans-type", "data/phantom"})
    for (const std::filesystem::path& file : scenes_in(folder)) {
      const Scene scene = read_scene(file);
      if (scene.sweep && !scene.laxity) expect_verified(computed_run(file), file.string());
    }
}

TEST(VerifyRun, FindsNothingWrongInAMotion) {
  const std::filesystem::path file = kSource / "data/phantom/blow.toml";
  expect_verified(computed_run(file, "simulate"), file.string(), false);
}

TEST(VerifyRun, FindsNothingWrongInSpecimens) {
  if (!std::filesystem::exists(kSpecimens)) GTEST_SKIP() << "no specimens beside the source";
  for (const char* scene :
       {"lenhart2015/knee.toml", "clouthier2019_ssm/knee.toml",
        "clouthier2019_ssm/population/S001.toml", "clouthier2019_ssm/population/S060.toml"})
    expect_verified(computed_run(kSpecimens / scene), scene);
}

TEST(VerifyRun, LooksAtEverythingThatTheFileHolds) {
  VerifyOptions options;
  options.pushes = true;
  const ColumnTree columns = columns_of(phantom_run());
  options.columns = &columns;
  const Verification v = verify_run(phantom_run(), options);
  EXPECT_EQ(v.converged, 25U);
  EXPECT_EQ(verdict(v), "25 of 25 poses converged, none of them is false");
  // The phantom has no elastic layers.
  for (std::size_t i = 0; i < v.checks.size(); ++i)
    EXPECT_EQ(v.checks[i].count > 0, i < static_cast<std::size_t>(Check::kDepth) ||
                                         i == static_cast<std::size_t>(Check::kColumns))
        << v.checks[i].name;
  const Verification layered = verify_run(computed_run(kSource / "data/phantom/layered.toml"));
  EXPECT_EQ(verdict(layered), "25 of 25 poses converged, none of them is false");
  for (std::size_t i = static_cast<std::size_t>(Check::kDepth); i < layered.checks.size(); ++i)
    EXPECT_EQ(layered.checks[i].count > 0, i < static_cast<std::size_t>(Check::kPath))
        << layered.checks[i].name;
}

// A roller of a metre: no bound tells along its line that it is free, and a gap of no more than rounding is none that was found.
TEST(VerifyRun, SaysWhatItCouldNotLookAt) {
  std::string text = bytes_of_file(kSource / "data/hard/line.toml");
  const auto put = [&text](const std::string& place, const std::string& words) {
    ASSERT_NE(text.find(place), std::string::npos) << place;
    text.replace(text.find(place), place.size(), words);
  };
  put("length = 40", "length = 1000");
  put("normal = [0, 0, 1]", "normal = [0, 0, 1]\nradius = 800");
  put("vary = \"translation y\"", "vary = \"rotation z\"");
  const std::filesystem::path file = test::fresh_folder("condyle verify line") / "line.toml";
  std::ofstream(file) << text;
  const Verification v = verify_run(computed_run(file));
  EXPECT_EQ(v.converged, 3U);
  EXPECT_TRUE(v.verified());
  EXPECT_EQ(v.checks.at(static_cast<std::size_t>(Check::kGap)).count, 0);
  EXPECT_EQ(
      std::count_if(
          v.not_checked.begin(), v.not_checked.end(),
          [](const std::string& what) {
            return what.find("too many places to look at (rotation z = 0 deg, and 2 more poses)") !=
                   std::string::npos;
          }),
      1);
}

/// The fault of one kind at 25 degrees, and that there is none at another pose.
std::string fault_of(const Run& run, Check check, bool alone = true) {
  VerifyOptions options;
  options.meshes = check == Check::kMesh;
  options.pushes = check == Check::kStability;
  const Verification v = verify_run(run, options);
  std::string text;
  for (const Fault& fault : v.faults) {
    if (alone) {
      EXPECT_EQ(fault.pose, 1U) << fault.text;
    }
    if (fault.check == check && fault.pose == 1) text = fault.text;
  }
  EXPECT_FALSE(v.verified());
  return text;
}

PoseResult& pose_of(Run& run) { return run.sweep.poses.at(1); }

TEST(VerifyCatches, APoseThatMovedByAHundredthOfAMillimetre) {
  for (int axis = 0; axis < 3; ++axis) {
    condyle::Run run = test::phantom_poses();
    pose_of(run).X_BA.p[axis] += 0.01;
    EXPECT_WORDS(fault_of(run, Check::kTogether), "flexion = 25 deg: contact \"");
    EXPECT_WORDS(fault_of(run, Check::kLength), "flexion = 25 deg: ligament \"");
  }
}

TEST(VerifyCatches, APoseThatIsNoMotion) {
  condyle::Run run = test::phantom_poses();
  pose_of(run).X_BA.R *= 1 + 1e-9;
  EXPECT_WORDS(fault_of(run, Check::kPose), "rotation is orthonormal");
  pose_of(run).X_BA.R(1, 1) = std::nan("");
  EXPECT_WORDS(fault_of(run, Check::kPose), "no rotation");
}

TEST(VerifyCatches, AForceThatIsWrongByAMillionth) {
  condyle::Run run = test::phantom_poses();
  std::size_t taut = 0;
  for (std::size_t i = 0; i < pose_of(run).ligaments.size(); ++i)
    if (pose_of(run).ligaments[i].force > 10) taut = i;
  pose_of(run).ligaments[taut].force *= 1 + 1e-6;
  EXPECT_WORDS(fault_of(run, Check::kLaw), "but its law gives");

  condyle::Run pressed = test::phantom_poses();
  ContactResult& contact = pose_of(pressed).contacts[0];
  contact.force *= 1 + 1e-6;
  for (ContactPointResult& point : contact.points) point.force *= 1 + 1e-6;
  EXPECT_WORDS(fault_of(pressed, Check::kForces), "flexion = 25 deg: forces add up to");

  condyle::Run held = test::phantom_poses();
  pose_of(held).conditions[0].multiplier += 1;  // N mm
  EXPECT_WORDS(fault_of(held, Check::kMoments), "flexion = 25 deg: moments add up to");
}

// A weight hangs on a string of 40 mm, 4 m from the origin: all forces act along one line, and no arm is known better than
// numbers of 4000 mm are. The string pulls at its end, so that moments are measured by arms of its length.
TEST(VerifyCatches, AMomentOfForcesAlongOneLine) {
  condyle::Run run;
  run.scene = parse_scene(R"(title = "pendulum"
[units]
length = "mm"
angle = "deg"
force = "N"
[[body]]
name = "ceiling"
fixed = true
[[body]]
name = "weight"
[[condition]]
name = "string"
kind = "distance"
value = 40
ends = [{ body = "ceiling", at = [2300, -2700, 1840] }, { body = "weight", at = [0, 0, 0] }]
[[load]]
name = "gravity"
body = "weight"
kind = "force"
vector = [0, 0, -18]
at = [2e-11, 0, -60]
follows = "ground"
[sweep]
vary = "string"
values = [40, 40, 40]
)",
                          "pendulum.toml");
  PoseResult pose;
  pose.value = 40;
  pose.status = PoseStatus::kConverged;
  pose.conditions = {{40, 18}};
  run.sweep.poses.assign(3, pose);
  for (PoseResult& hanging : run.sweep.poses) hanging.X_BA.p = {2300, -2700, 1800};
  EXPECT_TRUE(verify_run(run).verified())
      << "2e-11 mm beside the line is nothing that such numbers tell";
  pose_of(run).X_BA.R = exp_rotation({0, 1e-7, 0});
  EXPECT_WORDS(fault_of(run, Check::kMoments), "string = 40 mm: moments add up to");
}

TEST(VerifyCatches, AContactThatPulls) {
  condyle::Run run = test::phantom_poses();
  ContactPointResult& point = pose_of(run).contacts[1].points[0];
  point.force = -point.force;
  pose_of(run).contacts[1].force = point.force;
  EXPECT_WORDS(fault_of(run, Check::kPush), "contact \"lateral\": pulls with");
}

TEST(VerifyCatches, AResultantThatIsNotThatOfItsPoints) {
  condyle::Run run = test::phantom_poses();
  pose_of(run).contacts[0].resultant_ground.x() += 1e-6;
  EXPECT_WORDS(fault_of(run, Check::kTogether), "contact \"medial\": acts at [");
}

/// Of the three poses, with a dataset of their file altered.
Verification verified_with(const std::string& group,
                           const std::string& name,
                           const std::function<void(DataColumn&)>& alter) {
  const condyle::Run run = test::phantom_poses();
  ColumnTree columns = columns_of(run);
  ColumnTree* at = columns.groups.at("sweep").get();
  std::istringstream places(group);
  for (std::string place; std::getline(places, place, '/');)
    if (place != ".") at = at->groups.at(place).get();
  alter(at->columns.at(name));
  VerifyOptions options;
  options.meshes = false;
  options.columns = &columns;
  return verify_run(run, options);
}

TEST(VerifyCatches, ANumberThatTheRestOfTheFileContradicts) {
  for (const auto& [group, name] : {std::pair{"contacts/medial", "gap"},
                                    {"contacts/medial", "point_ground"},
                                    {"contacts/lateral", "force"},
                                    {"joint", "flexion"}}) {
    const Verification v = verified_with(group, name, [](DataColumn& column) {
      auto& numbers = std::get<std::vector<double>>(column.values);
      numbers[numbers.size() / 2] += 1e-6;
    });
    ASSERT_EQ(v.faults.size(), 1U) << group << "/" << name;
    EXPECT_EQ(v.faults[0].pose, 1U);
    EXPECT_WORDS(v.faults[0].text,
                 std::string("flexion = 25 deg: /sweep/") + group + "/" + name + ": row 1 holds ");
  }
}

TEST(VerifyCatches, DatasetsOfAnotherShapeOrWithOtherTexts) {
  const Verification shorter = verified_with("contacts/medial", "gap", [](DataColumn& column) {
    std::get<std::vector<double>>(column.values).pop_back();
    column.shape = {2};
  });
  ASSERT_EQ(shorter.faults.size(), 1U);
  EXPECT_EQ(shorter.faults[0].text,
            "/sweep/contacts/medial/gap: numbers [2], expected numbers [3]");
  const Verification texts = verified_with("contacts/medial", "gap", [](DataColumn& column) {
    column.values = std::vector<std::string>(3, "0");
  });
  ASSERT_EQ(texts.faults.size(), 1U);
  EXPECT_EQ(texts.faults[0].text, "/sweep/contacts/medial/gap: texts [3], expected numbers [3]");
  const Verification other = verified_with(".", "reason", [](DataColumn& column) {
    std::get<std::vector<std::string>>(column.values)[1] = "none";
  });
  ASSERT_EQ(other.faults.size(), 1U);
  EXPECT_WORDS(other.faults[0].text, "/sweep/reason: holds other texts");
}

// What is wrong with the first pose is told beside it.
TEST(VerifyCatches, AUnitThatCondyleDoesNotWrite) {
  const Verification v = verified_with("contacts/medial", "force", [](DataColumn& column) {
    column.units = "kN";
    std::get<std::vector<double>>(column.values)[0] += 1e-6;
  });
  ASSERT_EQ(v.faults.size(), 2U);
  EXPECT_EQ(v.faults[0].text, "/sweep/contacts/medial/force: unit \"kN\", expected \"N\"");
  EXPECT_WORDS(v.faults[1].text, "flexion = 20 deg: /sweep/contacts/medial/force: row 0 holds ");
}

TEST(VerifyCatches, ANormalThatTurned) {
  condyle::Run run = test::phantom_poses();
  Vector3d& n = pose_of(run).contacts[0].points[0].normal_ground;
  n = (n + 1e-5 * n.unitOrthogonal()).normalized();
  EXPECT_WORDS(fault_of(run, Check::kNormal), "contact \"medial\": the normal at");
}

TEST(VerifyCatches, AJointCoordinateAndAPrescribedAngleThatAreOff) {
  condyle::Run run = test::phantom_poses();
  pose_of(run).joint.internal_rotation += 1e-8;
  EXPECT_WORDS(fault_of(run, Check::kJoint), "internal rotation");
  condyle::Run other = test::phantom_poses();
  pose_of(other).value += 1e-8;
  EXPECT_WORDS(fault_of(other, Check::kCondition), "condition \"flexion\": is ");
}

TEST(VerifyCatches, AControlPointThatMoved) {
  condyle::Run run = test::phantom_poses();
  const Vector3d touch = pose_of(run).contacts[0].points[0].point_ground;
  PatchData* patch = nullptr;
  for (RunPatch& one : run.patches)
    if (one.surface == "medial condyle") patch = &one.data;
  ASSERT_NE(patch, nullptr);
  auto nearest = std::min_element(patch->control_points.begin(), patch->control_points.end(),
                                  [&](const Vector3d& a, const Vector3d& b) {
                                    return (a - touch).norm() < (b - touch).norm();
                                  });
  *nearest += 0.01 * (*nearest - touch).normalized() + Vector3d(0, 0.01, 0);
  EXPECT_WORDS(fault_of(run, Check::kOnSurface, false), "beside surface \"medial condyle\"");
}

TEST(VerifyCatches, BonesInsideEachOther) {
  // The whole tibia pushed up by a millimetre, with the points that are stored for it.
  condyle::Run run = test::phantom_poses();
  PoseResult& pose = pose_of(run);
  pose.X_BA.p += pose.X_BA.R * Vector3d(0, 1, 0);
  const std::string text = fault_of(run, Check::kGap);
  EXPECT_WORDS(text, "flexion = 25 deg: contact \"");
  EXPECT_WORDS(text, "overlap by ");
  const double depth = std::stod(text.substr(text.find("overlap by ") + 11));
  EXPECT_GT(depth, 0.8);
  EXPECT_LT(depth, 1.1);
}

TEST(VerifyCatches, BonesThatPassedThroughEachOther) {
  condyle::Run run = test::phantom_poses();
  PoseResult& pose = pose_of(run);
  pose.X_BA.p += pose.X_BA.R * Vector3d(0, 25, 0);
  for (ContactResult& contact : pose.contacts) {
    contact.closed = false;
    contact.points.clear();
    contact.force = 0;
  }
  EXPECT_WORDS(fault_of(run, Check::kMesh), "bones passed through each other");
  EXPECT_WORDS(fault_of(run, Check::kGap), "overlap by ");
}

// One file may hold both bones: a cube of 60 mm that either body has, the other's corner at its centre.
TEST(VerifyCatches, BonesOfOneFileThatPassedThroughEachOther) {
  const std::filesystem::path file =
      test::fresh_folder("condyle verify one mesh") / "both bones.off";
  test::write_off(file, test::cube(60));
  condyle::Run run = test::phantom_poses();
  run.bodies.clear();
  run.inputs.push_back({file.string(), sha256_of_file(file)});
  for (SurfaceDescription& surface : run.scene.surfaces)
    surface.patch.mesh = MeshFile{.path = file, .named_at = {}};
  pose_of(run).X_BA = {.R = Eigen::Matrix3d::Identity(), .p = Vector3d(30, 30, 30)};
  EXPECT_WORDS(fault_of(run, Check::kMesh, false),
               "30.00 mm of both bones.off lie inside both bones.off");
}

TEST(VerifyCatches, AnEdgeThatWasPassed) {
  condyle::Run run = test::phantom_poses();
  for (RunPatch& patch : run.patches)
    if (patch.surface == "lateral plateau")
      for (double& distance : patch.data.mask) distance -= 30;
  EXPECT_WORDS(fault_of(run, Check::kKnown, false),
               "beyond the known part of surface \"lateral plateau\"");
}

TEST(VerifyCatches, AnUnstablePoseThatIsCalledStable) {
  condyle::Run run = computed_run(kSource / "data/hard/bifurcation.toml");
  int unstable = 0;
  for (PoseResult& pose : run.sweep.poses) {
    if (!pose.converged() || !(pose.lowest_stiffness < -0.01)) continue;
    ++unstable;
    pose.stability = 1;
  }
  ASSERT_GT(unstable, 0);
  VerifyOptions options;
  options.pushes = true;
  const Verification v = verify_run(run, options);
  EXPECT_EQ(v.checks[static_cast<std::size_t>(Check::kStability)].failed, unstable);
}

TEST(VerifyRun, RefusesWhatHoldsNoPoses) {
  condyle::Run run = test::phantom_poses();
  run.sweep.poses.clear();
  EXPECT_THROW((void)verify_run(run), InputError);
  run = test::phantom_poses();
  run.patches.clear();
  EXPECT_THROW((void)verify_run(run), InputError);
}

}  // namespace
}  // namespace condyle
