#include "condyle/results/run_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "condyle/input_error.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/results/make_run.h"
#include "results/made_up_run.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

class RunFile : public testing::Test {
 protected:
  void SetUp() override {
    path_ = fs::path(testing::TempDir()) / ("condyle_run_" + std::to_string(::getpid()) + ".h5");
  }
  void TearDown() override { fs::remove(path_); }
  [[nodiscard]] std::string message() const {
    try {
      (void)read_run(path_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  fs::path path_;
};

void expect_same_point(const ContactPointResult& a, const ContactPointResult& b) {
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.point_ground, b.point_ground);
  EXPECT_EQ(a.point_moving, b.point_moving);
  EXPECT_EQ(a.normal_ground, b.normal_ground);
  EXPECT_EQ(a.gap, b.gap);
  EXPECT_EQ(a.relative_curvature, b.relative_curvature);
  EXPECT_EQ(a.on_edge, b.on_edge);
}

TEST_F(RunFile, GivesBackTheEvents) {
  condyle::Run run = made_up_run();
  run.sweep.events = {{0.25, EventKind::kOpening, 0},
                      {0.5, EventKind::kJump, 0},
                      {0.75, EventKind::kLimitPoint, -1}};
  write_run(path_, run);
  const condyle::Run back = read_run(path_);
  ASSERT_EQ(back.sweep.events.size(), 3U);
  EXPECT_NEAR(back.sweep.events[0].value, 0.25, 1e-16);  // to degrees and back
  EXPECT_EQ(back.sweep.events[0].kind, EventKind::kOpening);
  EXPECT_EQ(back.sweep.events[1].kind, EventKind::kJump);
  EXPECT_EQ(back.sweep.events[1].contact, 0);
  EXPECT_EQ(back.sweep.events[2].contact, -1);  // of the path, of no contact
}

TEST_F(RunFile, GivesBackThePoses) {
  const condyle::Run run = made_up_run();
  write_run(path_, run);
  const condyle::Run back = read_run(path_);
  ASSERT_EQ(back.sweep.poses.size(), 3U);
  for (const std::size_t i : {0U, 2U}) {
    const PoseResult &a = run.sweep.poses[i], &b = back.sweep.poses[i];
    EXPECT_NEAR(a.value, b.value, 1e-16);  // to degrees and back
    EXPECT_EQ(b.status, PoseStatus::kConverged);
    EXPECT_EQ(a.X_BA.R, b.X_BA.R);
    EXPECT_EQ(a.X_BA.p, b.X_BA.p);
    EXPECT_NEAR(a.joint.internal_rotation, b.joint.internal_rotation, 1e-16);
    EXPECT_EQ(a.joint.distraction, b.joint.distraction);
    EXPECT_EQ(a.contacts[0].closed, b.contacts[0].closed);
    EXPECT_EQ(a.contacts[0].force, b.contacts[0].force);
    ASSERT_EQ(a.contacts[0].points.size(), b.contacts[0].points.size());
    for (std::size_t k = 0; k < a.contacts[0].points.size(); ++k) {
      expect_same_point(a.contacts[0].points[k], b.contacts[0].points[k]);
    }
    EXPECT_EQ(a.ligaments[0].force, b.ligaments[0].force);
    EXPECT_EQ(a.ligaments[0].strain, b.ligaments[0].strain);
    EXPECT_NEAR(a.conditions[0].value, b.conditions[0].value, 1e-16);
    EXPECT_EQ(a.conditions[0].multiplier, b.conditions[0].multiplier);
    EXPECT_EQ(a.stability, b.stability);
    EXPECT_EQ(a.lowest_stiffness, b.lowest_stiffness);
    EXPECT_EQ(a.iterations, b.iterations);
    EXPECT_EQ(a.residual, b.residual);
    EXPECT_EQ(a.seconds, b.seconds);
    expect_same_trace(a.trace, b.trace);
  }
}

// What a run of before holds: nothing of how its poses were found.
TEST_F(RunFile, WithoutTracesIsRead) {
  condyle::Run run = made_up_run();
  for (PoseResult& pose : run.sweep.poses) pose.trace = PoseTrace();
  write_run(path_, run);
  EXPECT_FALSE(Hdf5Reader(path_).root().open("sweep").has("route"));
  for (const PoseResult& pose : read_run(path_).sweep.poses) EXPECT_FALSE(pose.trace.told());
}

// A pose that was not found keeps what its last iterations left.
TEST_F(RunFile, KeepsTheResidualsOfAPoseThatWasNotFound) {
  condyle::Run run = made_up_run();
  ResidualHistory& residuals = run.sweep.poses[1].trace.residuals;
  for (int k = 0; k < ResidualHistory::kMost; ++k) residuals.add(1.0 / (1 + k));
  write_run(path_, run);
  expect_same_trace(run.sweep.poses[1].trace, read_run(path_).sweep.poses[1].trace);
}

TEST_F(RunFile, GivesBackPatchesMeshesAndScene) {
  const condyle::Run run = made_up_run();
  write_run(path_, run);
  const condyle::Run back = read_run(path_);
  EXPECT_EQ(back.scene.text, run.scene.text);
  EXPECT_EQ(back.scene.file, run.scene.file);
  ASSERT_EQ(back.patches.size(), 1U);
  const PatchData &a = run.patches[0].data, &b = back.patches[0].data;
  EXPECT_EQ(a.degree, b.degree);
  EXPECT_EQ(a.knots_u, b.knots_u);
  EXPECT_EQ(a.knots_v, b.knots_v);
  EXPECT_EQ(a.nu, b.nu);
  EXPECT_EQ(a.nv, b.nv);
  EXPECT_EQ(a.control_points, b.control_points);
  EXPECT_EQ(a.orientation, b.orientation);
  EXPECT_EQ(a.mask_nu, b.mask_nu);
  EXPECT_EQ(a.mask_nv, b.mask_nv);
  EXPECT_EQ(a.mask, b.mask);
  EXPECT_EQ(back.patches[0].body, 0);
  const FitReport &p = run.patches[0].report, &q = back.patches[0].report;
  EXPECT_EQ(p.mesh_vertices, q.mesh_vertices);
  EXPECT_EQ(p.control_points, q.control_points);
  EXPECT_EQ(p.rms, q.rms);
  EXPECT_EQ(p.core_max, q.core_max);
  EXPECT_DOUBLE_EQ(p.normal_rms, q.normal_rms);
  EXPECT_EQ(p.curvature_range, q.curvature_range);
  EXPECT_EQ(p.notes, q.notes);
  ASSERT_EQ(back.bodies.size(), 2U);
  EXPECT_EQ(back.bodies[0].name, "femur");
  EXPECT_EQ(back.bodies[0].mesh.vertices, run.bodies[0].mesh.vertices);
  EXPECT_EQ(back.bodies[0].mesh.triangles, run.bodies[0].mesh.triangles);
  EXPECT_TRUE(back.bodies[1].mesh.vertices.empty());
}

// What no patch can be evaluated with: each by itself, in a run that is right otherwise.
TEST_F(RunFile, WithADamagedPatchIsRefused) {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  const auto refused = [&](const char* what, void (*damage)(PatchData&, double), double with) {
    condyle::Run run = made_up_run();
    damage(run.patches[0].data, with);
    write_run(path_, run);
    EXPECT_NE(message().find(what), std::string::npos) << message();
  };
  const auto knot_u = [](PatchData& patch, double x) { patch.knots_u[4] = x; };
  for (const double x : {nan, infinity, 3.0, 2.5}) refused("dataset knots_u holds", knot_u, x);
  refused(
      "dataset knots_v holds", [](PatchData& patch, double x) { patch.knots_v[0] = x; }, 1.5);
  const auto point = [](PatchData& patch, double x) { patch.control_points[7].y() = x; };
  for (const double x : {nan, infinity}) refused("dataset control_points holds", point, x);
  const auto mask = [](PatchData& patch, double x) { patch.mask[3] = x; };
  for (const double x : {nan, infinity}) refused("dataset mask is", mask, x);
  const auto orientation = [](PatchData& patch, double x) {
    patch.orientation = static_cast<int>(x);
  };
  refused("dataset orientation is", orientation, 0);
}

// A pose beyond the edge of a patch is an equilibrium on the extrapolated surface: all of it is
// there.
TEST_F(RunFile, KeepsAPoseBeyondAnEdge) {
  condyle::Run run = made_up_run();
  PoseResult& pose = run.sweep.poses[0];
  pose.status = PoseStatus::kLeftPatch;
  pose.reason = "beyond";
  pose.event_seconds = 3e-4;
  write_run(path_, run);
  const PoseResult back = read_run(path_).sweep.poses[0];
  EXPECT_EQ(back.status, PoseStatus::kLeftPatch);
  EXPECT_EQ(back.reason, "beyond");
  EXPECT_TRUE(back.solved());
  EXPECT_EQ(back.X_BA.p, pose.X_BA.p);
  EXPECT_TRUE(back.contacts[0].closed);
  ASSERT_EQ(back.contacts[0].points.size(), pose.contacts[0].points.size());
  EXPECT_EQ(back.contacts[0].points[0].force, pose.contacts[0].points[0].force);
  EXPECT_EQ(back.ligaments[0].force, pose.ligaments[0].force);
  EXPECT_EQ(back.stability, pose.stability);
  EXPECT_EQ(back.event_seconds, 3e-4);
}

TEST_F(RunFile, MarksAFailedPoseWithNanAndItsReason) {
  write_run(path_, made_up_run());
  const Hdf5Reader reader(path_);
  const Hdf5Group sweep = reader.root().open("sweep");
  EXPECT_EQ(sweep.read_integers("status", {3}), (std::vector<int>{0, 3, 0}));
  EXPECT_EQ(sweep.read_texts("reason")[1], "nothing resists turning about x");
  EXPECT_TRUE(std::isnan(sweep.open("pose").read("translation", {3, 3})[3]));
  EXPECT_TRUE(std::isnan(sweep.open("joint").read("distraction", {3})[1]));
  EXPECT_TRUE(std::isnan(sweep.open("ligaments").open("aACL").read("force", {3})[1]));
  EXPECT_EQ(sweep.open("contacts").open("medial").read_integers("state", {3}),
            (std::vector<int>{1, -1, 1}));
  EXPECT_TRUE(std::isnan(sweep.open("contacts").open("medial").read("gap", {3})[1]));
}

// Numbers of made_up_run in the units that the file promises.
TEST_F(RunFile, HoldsDegreesMillimetresAndNewtons) {
  write_run(path_, made_up_run());
  const Hdf5Reader reader(path_);
  const Hdf5Group sweep = reader.root().open("sweep");
  EXPECT_NEAR(sweep.read("value", {3})[2], 0.2 * 180 / M_PI, 1e-13);
  EXPECT_NEAR(sweep.open("joint").read("internal_rotation", {3})[0], 0.3 * 180 / M_PI, 1e-13);
  EXPECT_EQ(sweep.open("joint").read("lateral_shift", {3})[0], 4);
  EXPECT_EQ(sweep.open("pose").read("rotation", {3, 3, 3})[1], -1);  // row 0, column 1
  const Hdf5Group medial = sweep.open("contacts").open("medial");
  EXPECT_EQ(medial.read("force", {3})[2], 70);           // the sum, 30 + 40 N
  EXPECT_EQ(medial.read("point_ground", {3, 3})[6], 4);  // of the point that carries more
  EXPECT_EQ(medial.open("points").read("force", {3, 2})[4], 30);
  EXPECT_TRUE(
      std::isnan(medial.open("points").read("force", {3, 2})[1]));  // the first pose has one point
  EXPECT_EQ(sweep.open("conditions").open("bend").read("multiplier", {3})[2], -40);
}

TEST_F(RunFile, HoldsASceneTextOf200Kilobytes) {
  // Attributes of HDF5 proper end at 64 KB.
  condyle::Run run = made_up_run();
  run.scene.text += "# " + std::string(200000, 'x') + "\n";
  write_run(path_, run);
  EXPECT_EQ(read_run(path_).scene.text, run.scene.text);
}

TEST_F(RunFile, CompressesALargeMesh) {
  condyle::Run run = made_up_run();
  TriangleMesh& mesh = run.bodies[1].mesh;
  for (int i = 0; i < 30000; ++i) mesh.vertices.emplace_back(i, 0, 0);
  for (int i = 0; i + 2 < 30000; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
  write_run(path_, run);
  EXPECT_LT(fs::file_size(path_), 500000U);  // 1.08 MB of plain numbers
  const condyle::Run back = read_run(path_);
  EXPECT_EQ(back.bodies[1].mesh.vertices, mesh.vertices);
  EXPECT_EQ(back.bodies[1].mesh.triangles, mesh.triangles);
}

TEST_F(RunFile, OfAFitHasNoSweep) {
  condyle::Run run = made_up_run();
  run.sweep.poses.clear();
  write_run(path_, run);
  const condyle::Run back = read_run(path_);
  EXPECT_TRUE(back.sweep.poses.empty());
  EXPECT_EQ(back.patches.size(), 1U);
}

TEST_F(RunFile, WithoutAJointHasNoJointCoordinates) {
  condyle::Run run = made_up_run();
  std::string text = kSmallScene;
  text.erase(text.find("[joint]"), text.find("[[surface]]") - text.find("[joint]"));
  text = with(text, "kind = \"flexion\"", "kind = \"rotation\"\naxis = \"z\"");
  run.scene = parse_scene(text, "knee.toml");
  write_run(path_, run);
  EXPECT_FALSE(Hdf5Reader(path_).root().open("sweep").has("joint"));
  EXPECT_EQ(read_run(path_).sweep.poses[2].X_BA.p, run.sweep.poses[2].X_BA.p);
}

TEST_F(RunFile, ThatIsMissingIsNamed) {
  EXPECT_EQ(message(), path_.string() + ": no such file, expected a run (HDF5)");
}

TEST_F(RunFile, ThatIsSomethingElseIsNamed) {
  std::ofstream(path_) << "solid femur\n";
  EXPECT_EQ(message(),
            path_.string() + ": cannot be opened, expected a run (HDF5), whole and readable");
}

TEST_F(RunFile, ThatIsCutShortIsNamed) {
  write_run(path_, made_up_run());
  fs::resize_file(path_, fs::file_size(path_) / 2);
  EXPECT_EQ(message(),
            path_.string() + ": cannot be opened, expected a run (HDF5), whole and readable");
}

TEST_F(RunFile, OfALaterFormatSaysSo) {
  const Hdf5Builder builder("x.h5");
  builder.root().write_attribute("format", "condyle 9");
  std::ofstream(path_, std::ios::binary) << builder.bytes();
  EXPECT_EQ(message(), path_.string() +
                           ": /: written by a later condyle (format \"condyle 9\"), this one "
                           "reads up to \"condyle 1\"");
}

TEST_F(RunFile, OfAnotherFormatIsNamed) {
  const Hdf5Builder builder("x.h5");
  builder.root().write_attribute("format", "condyle x");
  std::ofstream(path_, std::ios::binary) << builder.bytes();
  EXPECT_EQ(message(), path_.string() + ": /: format = \"condyle x\", expected \"condyle 1\"");
}

TEST_F(RunFile, WithoutADatasetNamesIt) {
  const Hdf5Builder builder("x.h5");
  const condyle::Run run = made_up_run();
  builder.root().write_attribute("format", "condyle 1");
  builder.root().write_attribute("scene", run.scene.text);
  builder.root().write_attribute("scene_file", "knee.toml");
  builder.root().create("sweep").write("value", std::vector<double>{1, 2}, {2}, "deg");
  std::ofstream(path_, std::ios::binary) << builder.bytes();
  EXPECT_EQ(message(), path_.string() + ": /sweep/: dataset status is missing");
}

// The contract: every dataset tells its units.
void expect_units(const Hdf5Group& group, int& datasets) {
  for (const std::string& name : group.names()) {
    if (group.is_group(name)) {
      expect_units(group.open(name), datasets);
    } else {
      ++datasets;
      EXPECT_FALSE(group.read_attribute(name, "units").empty()) << name;
    }
  }
}

TEST_F(RunFile, TellsTheUnitsOfEveryDataset) {
  write_run(path_, made_up_run());
  int datasets = 0;
  const Hdf5Reader reader(path_);
  expect_units(reader.root(), datasets);
  EXPECT_GT(datasets, 50);
  EXPECT_EQ(reader.root().open("sweep").read_attribute("value", "units"), "deg");
  EXPECT_EQ(
      reader.root().open("sweep").open("stability").read_attribute("lowest_stiffness", "units"),
      "N/mm");
}

TEST(MeshFiles, ThatHaveChangedAreNamed) {
  const std::vector<InputFile> before = {{"a.stl", "12"}, {"b.stl", "34"}};
  EXPECT_NO_THROW(expect_same(before, before));
  try {
    expect_same(before, {{"a.stl", "12"}, {"b.stl", "35"}});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "b.stl: has changed while it was read, expected a mesh that stays as it is");
  }
}

}  // namespace
}  // namespace condyle
