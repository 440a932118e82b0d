/// Tables of a run (CSV, .mot, .sto) and posed meshes (STL), parsed again by hand.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cstring>
#include <map>
#include <sstream>

#include "condyle/exchange/csv_run.h"
#include "condyle/exchange/opensim_run.h"
#include "condyle/exchange/stl_run.h"
#include "condyle/input_error.h"
#include "exchange/phantom_run.h"
#include "results/made_up_run.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using test::phantom_run;

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

TEST(CsvOfARun, GivesBackEveryNumberBitForBit) {
  const condyle::Run& run = phantom_run();
  std::map<std::string, double> numbers;  // "1 ligament aACL force N"
  const std::vector<std::string> lines = split(csv_of_poses(run, shown_poses(run, "run.h5")), '\n');
  EXPECT_EQ(lines[0], "pose,swept,swept_unit,quantity,name,component,value,unit");
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> cells = split(lines[i], ',');
    ASSERT_EQ(cells.size(), 8U) << lines[i];
    const std::string key =
        cells[0] + " " + cells[3] + " " + cells[4] + " " + cells[5] + " " + cells[7];
    EXPECT_TRUE(numbers.emplace(key, std::stod(cells[6])).second) << key << " stands there twice";
  }
  for (std::size_t p = 0; p < 3; ++p) {
    const PoseResult& pose = run.sweep.poses[p];
    const std::string head = std::to_string(p) + " ";
    for (std::size_t i = 0; i < pose.ligaments.size(); ++i) {
      const std::string name = head + "ligament " + run.scene.ligaments[i].name;
      EXPECT_EQ(numbers.at(name + " force N"), pose.ligaments[i].force);
      EXPECT_EQ(numbers.at(name + " strain 1"), pose.ligaments[i].strain);
    }
    EXPECT_EQ(numbers.at(head + "pose tibia translation_y mm"), pose.X_BA.p.y());
    EXPECT_EQ(numbers.at(head + "pose tibia rotation_x_z 1"), pose.X_BA.R(0, 2));
    EXPECT_EQ(numbers.at(head + "contact lateral force N"), pose.contacts[1].force);
  }
}

// A law without a slack length knows no strain: the 0 of a result is none.
TEST(CsvOfARun, TellsNoStrainWhereALawHasNone) {
  condyle::Run run = phantom_run();
  const std::string name = run.scene.ligaments[0].name;
  const auto rows = [&] {
    const std::string text = csv_of_poses(run, shown_poses(run, "run.h5"));
    return std::pair{text.find(",ligament," + name + ",strain,") != std::string::npos,
                     text.find(",ligament," + name + ",force,") != std::string::npos};
  };
  EXPECT_EQ(rows(), (std::pair{true, true}));
  run.scene.ligaments[0].law = make_table_law({10, 20}, {0, 5});
  EXPECT_EQ(rows(), (std::pair{false, true}));
}

TEST(CsvOfARun, QuotesNamesThatNeedIt) {
  condyle::Run run = made_up_run();
  run.scene.ligaments[0].name = "a, \"b\"";
  const std::string text = csv_of_poses(run, shown_poses(run, "run.h5"));
  EXPECT_NE(text.find(",ligament,\"a, \"\"b\"\"\",force,14,N\n"), std::string::npos) << text;
  run.scene.ligaments[0].name = "=1+1";
  EXPECT_NE(csv_of_poses(run, shown_poses(run, "run.h5")).find(",ligament,\"'=1+1\",force,14,N\n"),
            std::string::npos);                     // no formula to a spreadsheet
  EXPECT_EQ(text.find("\n1,"), std::string::npos);  // the pose that failed
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

/// A table of OpenSim: the header's entries and the columns by label.
struct Storage {
  std::map<std::string, std::string> header;
  std::vector<std::string> labels;
  std::map<std::string, std::vector<double>> columns;
};
Storage parse_storage(const std::string& text) {
  Storage storage;
  std::istringstream stream(text);
  std::string line;
  while (std::getline(stream, line) && line != "endheader") {
    const std::size_t at = line.find('=');
    if (at != std::string::npos) storage.header[line.substr(0, at)] = line.substr(at + 1);
  }
  std::getline(stream, line);
  storage.labels = split(line, '\t');
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = split(line, '\t');
    EXPECT_EQ(cells.size(), storage.labels.size());
    for (std::size_t i = 0; i < cells.size(); ++i)
      storage.columns[storage.labels[i]].push_back(std::stod(cells[i]));
  }
  return storage;
}

TEST(OpenSimTables, PutTheTibiaWhereTheJamKneeWouldPutIt) {
  const condyle::Run& run = phantom_run();
  Storage mot = parse_storage(mot_of_poses(run, shown_poses(run, "run.h5"), "run.h5"));
  EXPECT_EQ(mot.header["version"], "1");
  EXPECT_EQ(mot.header["nRows"], "3");
  EXPECT_EQ(mot.header["nColumns"], "7");
  EXPECT_EQ(mot.header["inDegrees"], "yes");
  ASSERT_EQ(mot.labels[0], "time");
  for (std::size_t i = 0; i < 3; ++i) {
    const auto q = [&](const char* label) { return mot.columns.at(label).at(i); };
    const auto turn = [](double degrees, int axis) {
      return Eigen::AngleAxisd(degrees * M_PI / 180, Vector3d::Unit(axis)).toRotationMatrix();
    };
    // The law of OpenSim-JAM's knee_r, whose frames are the phantom's anatomical ones.
    const Eigen::Matrix3d R =
        turn(-q("knee_flex_r"), 2) * turn(q("knee_add_r"), 0) * turn(q("knee_rot_r"), 1);
    const Vector3d t(q("knee_tx_r"), q("knee_ty_r"), q("knee_tz_r"));
    const RigidTransform& X = run.sweep.poses[i].X_BA;
    EXPECT_LT((R - X.R).norm(), 1e-13);
    EXPECT_LT((1e3 * t - X.p).norm(), 1e-12);
    EXPECT_NEAR(q("time"), 3.0 * static_cast<double>(i), 1e-12);
  }
}

// A left knee is the mirror image of a right one: all six coordinates stay what they were.
TEST(OpenSimTables, GiveALeftKneeTheCoordinatesOfItsMirrorImage) {
  const condyle::Run& run = phantom_run();
  Scene left = run.scene;
  left.joint->side = Side::kLeft;
  for (AnatomicalFrame* frame : {&left.joint->femur, &left.joint->tibia}) frame->lateral.z() *= -1;
  PoseResult mirrored = run.sweep.poses[2];
  const Eigen::DiagonalMatrix<double, 3> M(1, 1, -1);
  mirrored.X_BA.R = M * mirrored.X_BA.R * M;
  mirrored.X_BA.p.z() *= -1;
  const JamCoordinates a = jam_coordinates(run.scene, run.sweep.poses[2]),
                       b = jam_coordinates(left, mirrored);
  EXPECT_NEAR(a.flex, b.flex, 1e-14);
  EXPECT_NEAR(a.add, b.add, 1e-14);
  EXPECT_NEAR(a.rot, b.rot, 1e-14);
  EXPECT_LT((a.translation - b.translation).norm(), 1e-13);
}

TEST(OpenSimTables, HoldForcesInNewtonAndPlacesInMetres) {
  const condyle::Run& run = phantom_run();
  Storage sto = parse_storage(sto_of_poses(run, shown_poses(run, "run.h5")));
  EXPECT_EQ(sto.header["nColumns"], std::to_string(sto.labels.size()));
  const PoseResult& pose = run.sweep.poses[1];
  EXPECT_EQ(sto.columns.at("LCL.force")[1], pose.ligaments[4].force);
  EXPECT_NEAR(sto.columns.at("LCL.length")[1], 1e-3 * pose.ligaments[4].length, 1e-15);
  Vector3d force, place;
  for (int k = 0; k < 3; ++k) {
    force[k] = sto.columns.at(std::string("lateral.force_v") + "xyz"[k])[1];
    place[k] = 1e3 * sto.columns.at(std::string("lateral.force_p") + "xyz"[k])[1];
  }
  EXPECT_NEAR(force.norm(), pose.contacts[1].force, 1e-9);  // one point
  EXPECT_LT(force.y(), 0);                                  // the femur presses the tibia down
  EXPECT_LT((place - pose.contacts[1].points[0].point_ground).norm(), 1e-9);
}

TEST(OpenSimTables, KeepBlanksOutOfLabels) {
  condyle::Run run = made_up_run();
  run.scene.ligaments[0].name = "anterior cruciate";
  const std::string text = sto_of_poses(run, shown_poses(run, "run.h5"));
  EXPECT_NE(text.find("\tanterior_cruciate.force\t"), std::string::npos) << text;
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

TEST(OpenSimTables, TwoColumnsOfOneLabelAreRefused) {
  condyle::Run run = phantom_run();
  run.scene.ligaments[0].name = "a ACL";
  run.scene.ligaments[1].name = "a_ACL";
  EXPECT_THROW((void)sto_of_poses(run, shown_poses(run, "run.h5")), InputError);
}

TEST(OpenSimTables, NeedAJointForMotion) {
  condyle::Run run = made_up_run();
  run.scene.joint.reset();
  EXPECT_THROW((void)mot_of_poses(run, shown_poses(run, "run.h5"), "run.h5"), InputError);
}

struct Solid {
  std::size_t triangles = 0;
  double volume = 0;                   ///< [mm³]
  Vector3d centre = Vector3d::Zero();  ///< [mm]
};
/// By the divergence theorem, from the bytes of a binary STL.
Solid solid_of(const std::string& stl) {
  Solid solid;
  std::uint32_t count = 0;
  std::memcpy(&count, stl.data() + 80, 4);
  EXPECT_EQ(stl.size(), 84 + 50 * static_cast<std::size_t>(count));
  solid.triangles = count;
  for (std::size_t i = 0; i < count; ++i) {
    float raw[12];
    std::memcpy(raw, stl.data() + 84 + 50 * i, sizeof raw);
    const Eigen::Map<const Eigen::Vector3f> n(raw), a(raw + 3), b(raw + 6), c(raw + 9);
    const Vector3d A = a.cast<double>(), B = b.cast<double>(), C = c.cast<double>();
    const double part = A.dot(B.cross(C)) / 6;
    solid.volume += part;
    solid.centre += part * (A + B + C) / 4;
    EXPECT_GE(n.cast<double>().dot((B - A).cross(C - A)), -1e-4);
  }
  solid.centre /= solid.volume;
  return solid;
}

TEST(StlOfARun, MovesABoneAndKeepsItsVolume) {
  const condyle::Run& run = phantom_run();
  const std::vector<ExportFile> files =
      stl_of_poses(run, shown_poses(run, "run.h5"), run_shapes(run), "run");
  std::map<std::string, Solid> bones;
  for (const ExportFile& file : files) {
    if (file.path.filename().string().find("bone") != std::string::npos)
      bones[file.path.generic_string()] = solid_of(file.bytes);
  }
  ASSERT_EQ(bones.size(), 4U);
  const Solid& first = bones.at("run_stl/tibia_bone_0000.stl");
  const Solid& last = bones.at("run_stl/tibia_bone_0002.stl");
  EXPECT_EQ(first.triangles, run.bodies[1].mesh.triangles.size());
  EXPECT_GT(first.volume, 1e5);
  EXPECT_NEAR(last.volume / first.volume, 1, 1e-6);  // coordinates are floats
  const RigidTransform X = run.sweep.poses[2].X_BA * run.sweep.poses[0].X_BA.inverse();
  EXPECT_LT((X * first.centre - last.centre).norm(), 1e-4);
}

TEST(ShownPoses, TakesThoseNearestToWhatIsAskedFor) {
  const condyle::Run& run = phantom_run();
  const std::vector<ShownPose> shown = shown_poses_at(run, "run.h5", {58, 2, 60.4});
  ASSERT_EQ(shown.size(), 2U);
  EXPECT_EQ(shown[0].index, 0U);
  EXPECT_EQ(shown[1].index, 2U);
  try {
    (void)shown_poses_at(run, "run.h5", {90});
    FAIL() << "expected an error";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "--at 90: run.h5 holds 0 to 60 deg");
  }
}

}  // namespace
}  // namespace condyle
