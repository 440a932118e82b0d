/// Meshes and points of OpenSim models on offset frames, in every way in which OpenSim writes them:
/// they have to land where OpenSim puts them.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>

#include "condyle/exchange/osim_scene.h"
#include "condyle/exchange/ply_file.h"
#include "condyle/input_error.h"
#include "condyle/mesh_files/load_mesh.h"
#include "condyle/scene_file/read_scene.h"
#include "scene/small_scene.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

const std::string kRoot = CONDYLE_SOURCE_DIR;
const std::string kFemur = "/bodyset/femur_distal_r";
const std::string kPose =
    "<translation>0.01 -0.02 0.03</translation><orientation>0.1 -0.2 0.3</orientation>";

/// R = Rx(0.1) Ry(-0.2) Rz(0.3), written out; 10, -20, 30 mm.
RigidTransform pose() {
  const double a = 0.1, b = -0.2, c = 0.3;
  RigidTransform X;
  X.R << cos(b) * cos(c), -cos(b) * sin(c), sin(b), cos(a) * sin(c) + sin(a) * sin(b) * cos(c),
      cos(a) * cos(c) - sin(a) * sin(b) * sin(c),
      -sin(a) * cos(b),  //
      sin(a) * sin(c) - cos(a) * sin(b) * cos(c), sin(a) * cos(c) + cos(a) * sin(b) * sin(c),
      cos(a) * cos(b);
  X.p = {10, -20, 30};
  return X;
}

std::string frame(const std::string& name, const std::string& parent, const std::string& inside) {
  return "<PhysicalOffsetFrame name=\"" + name + "\">" + parent + kPose + inside +
         "</PhysicalOffsetFrame>";
}
std::string to(const std::string& path) { return "<socket_parent>" + path + "</socket_parent>"; }
std::string components(const std::string& list) { return "<components>" + list + "</components>"; }

class OsimFramesTest : public testing::Test {
 protected:
  void SetUp() override {
    std::ifstream stream(kRoot + "/tests/data/phantom_jam.osim");
    text_ = {std::istreambuf_iterator<char>(stream), {}};
    for (std::size_t at; (at = text_.find("../../meshes")) != std::string::npos;)
      text_.replace(at, 12, kRoot + "/meshes");
    plain_ = load_mesh(kRoot + "/meshes/femur.stl", 1);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// The model with `in_femur` among the femur's elements and the femoral cartilage on
  /// `mesh_frame`.
  [[nodiscard]] std::string model(const std::string& in_femur,
                                  const std::string& mesh_frame) const {
    const std::string socket = "<Smith2018ContactMesh name=\"femur_cartilage\">\n<socket_frame>";
    return with(
        with(text_, "<Body name=\"femur_distal_r\">", "<Body name=\"femur_distal_r\">" + in_femur),
        socket + kFemur, socket + mesh_frame);
  }

  [[nodiscard]] OsimScene imported(const std::string& text) const {
    const fs::path file = folder_ / "model.osim";
    std::ofstream(file) << text;
    const OsimModel model = read_osim(file);
    return osim_scene(model, find_knee(model, "model.osim"), file, folder_ / "scene.toml");
  }

  /// The femoral cartilage, written once, lies at X.
  void expect_moved(const std::string& text, const RigidTransform& X) const {
    const OsimScene scene = imported(text);
    ASSERT_EQ(scene.meshes.size(), 1U);
    const TriangleMesh& mesh = scene.meshes[0].mesh;
    ASSERT_EQ(mesh.vertices.size(), plain_.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); i += 97)
      ASSERT_LT((mesh.vertices[i] - X * plain_.vertices[i]).norm(), 1e-9);
  }

  void expect_error(const std::string& text, const std::string& message) const {
    try {
      (void)imported(text);
      FAIL() << "expected: " << message;
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), message);
    }
  }

  fs::path folder_ = test::fresh_folder("osim frames");
  std::string text_;
  TriangleMesh plain_;
};

TEST_F(OsimFramesTest, AFrameOfABodyIsFoundByAnyPath) {
  const std::string shell = components(frame("shell", to(".."), ""));
  for (const char* path : {"/bodyset/femur_distal_r/shell", "../../bodyset/femur_distal_r/shell",
                           "../../bodyset/tibia_r/../femur_distal_r/./shell", "shell"})
    expect_moved(model(shell, path), pose());
  expect_moved(model(components(frame("shell", to(kFemur), "")), kFemur + "/shell"), pose());
}

TEST_F(OsimFramesTest, FramesOnFramesAddUp) {
  const std::string inner = components(frame("inner", to(".."), ""));
  expect_moved(model(components(frame("outer", to(".."), inner)), kFemur + "/outer/inner"),
               pose() * pose());
  const std::string sibling = frame("outer", to(".."), "") + frame("inner", to("../outer"), "");
  expect_moved(model(components(sibling), kFemur + "/inner"), pose() * pose());
}

TEST_F(OsimFramesTest, FramesStandInJointsMeshesAndTheModelToo) {
  const std::string shell = frame("shell", to(kFemur), "");
  expect_moved(with(model("", "/jointset/knee_r/shell"), "<CustomJoint name=\"knee_r\">",
                    "<CustomJoint name=\"knee_r\"><frames>" + shell + "</frames>"),
               pose());
  expect_moved(with(model("", "shell"), "<Smith2018ContactMesh name=\"femur_cartilage\">",
                    "<Smith2018ContactMesh name=\"femur_cartilage\">" + components(shell)),
               pose());
  expect_moved(with(model("", "/shell"), "<BodySet", components(shell) + "<BodySet"), pose());
}

TEST_F(OsimFramesTest, TheSpellingsOfOpenSimBeforeItsReleaseAreRead) {
  const std::string version = "Version=\"40000\"", old = "Version=\"30508\"";
  for (const std::string& socket :
       {std::string("<socket_parent_connectee_name>..</socket_parent_connectee_name>"),
        std::string("<connector_parent_connectee_name>..</connector_parent_connectee_name>"),
        std::string("<connectors><Connector_PhysicalFrame_ name=\"parent\"><connectee_name>.."
                    "</connectee_name></Connector_PhysicalFrame_></connectors>")})
    expect_moved(
        with(model(components(frame("shell", socket, "")), kFemur + "/shell"), version, old),
        pose());
}

TEST_F(OsimFramesTest, AMeshHasAPlaceInItsFrame) {
  const std::string here =
      "femur_distal_r</socket_frame>\n<location>0 0 0</location>\n"
      "<orientation>0 0 0</orientation>";
  const std::string there =
      "femur_distal_r</socket_frame>\n<location>0.01 -0.02 0.03</location>\n"
      "<orientation>0.1 -0.2 0.3</orientation>";
  expect_moved(with(text_, here, there), pose());
}

TEST_F(OsimFramesTest, ScalesComeBeforeTheFrameAndMayMirror) {
  const std::string scaled = "<scale_factors>0.001 0.002 -0.001</scale_factors>";
  std::string text = model(components(frame("shell", to(".."), "")), kFemur + "/shell");
  const std::size_t mesh = text.find("<Smith2018ContactMesh name=\"femur_cartilage\">");
  const std::size_t at = text.find("<scale_factors>", mesh);
  text.replace(at, text.find("</scale_factors>", at) + 16 - at, scaled);
  const OsimScene scene = imported(text);
  ASSERT_EQ(scene.meshes.size(), 1U);
  const TriangleMesh& moved = scene.meshes[0].mesh;
  const auto volume = [](const TriangleMesh& m) {
    double sum = 0;
    for (const auto& t : m.triangles)
      sum += m.vertices[t[0]].dot(m.vertices[t[1]].cross(m.vertices[t[2]])) / 6;
    return sum;
  };
  EXPECT_NEAR(volume(moved) / volume(plain_), 2, 1e-9);  // not -2: outside stays outside
  const Vector3d stretched(plain_.vertices[7].x(), 2 * plain_.vertices[7].y(),
                           -plain_.vertices[7].z());
  EXPECT_LT((moved.vertices[7] - pose() * stretched).norm(), 1e-9);
}

TEST_F(OsimFramesTest, WhatIsWrittenBesideTheSceneIsWhatTheSceneReads) {
  const OsimScene scene =
      imported(model(components(frame("shell", to(".."), "")), kFemur + "/shell"));
  ASSERT_EQ(scene.meshes.size(), 1U);
  const OsimMovedMesh& moved = scene.meshes[0];
  EXPECT_EQ(moved.file, folder_ / "scene_femur_cartilage.ply");
  std::ofstream(moved.file) << ply(moved.mesh);
  const Scene read = parse_scene(scene.text, folder_ / "scene.toml");
  const std::optional<MeshFile>& mesh = read.surfaces[0].patch.mesh;
  ASSERT_TRUE(mesh);
  const TriangleMesh again = load_mesh(mesh->path, mesh->to_mm);
  ASSERT_EQ(again.triangles, moved.mesh.triangles);
  for (std::size_t i = 0; i < again.vertices.size(); ++i)  // 1e-5: as a float of 60 mm
    ASSERT_LT((again.vertices[i] - moved.mesh.vertices[i]).norm(), 1e-5);
  EXPECT_EQ(read.surfaces[0].patch.mesh->path, read.surfaces[2].patch.mesh->path);
}

TEST_F(OsimFramesTest, PointsOfLigamentsFollowTheirFrames) {
  const std::string point = "aACL-P1\"><socket_parent_frame>" + kFemur;
  const std::string shell = components(frame("shell", to(".."), ""));
  const OsimScene scene = imported(with(model(shell, kFemur), point, point + "/shell"));
  EXPECT_TRUE(scene.meshes.empty());
  const Scene read = parse_scene(scene.text, folder_ / "scene.toml");
  EXPECT_LT((read.ligaments[0].ends[0].at - pose() * Vector3d(-3.28, 3.04, 7.72)).norm(), 1e-9);
}

TEST_F(OsimFramesTest, WhatCannotBePlacedIsRefused) {
  expect_error(model("", kFemur + "/shell"),
               "model.osim: Smith2018ContactMesh \"femur_cartilage\": there is no frame "
               "/bodyset/femur_distal_r/shell");
  expect_error(model("", "../../bodyset/shell"),
               "model.osim: Smith2018ContactMesh \"femur_cartilage\": there is no frame "
               "../../bodyset/shell (from /contactgeometryset/femur_cartilage)");
  // ".." of a frame in a joint is the joint, which is no frame.
  expect_error(
      with(model("", "/jointset/knee_r/shell"), "<CustomJoint name=\"knee_r\">",
           "<CustomJoint name=\"knee_r\"><frames>" + frame("shell", to(".."), "") + "</frames>"),
      "model.osim: PhysicalOffsetFrame \"shell\": there is no frame .. (from "
      "/jointset/knee_r/shell)");
  const std::string twice = frame("a", to(".."), components(frame("shell", to(".."), ""))) +
                            frame("b", to(".."), components(frame("shell", to(".."), "")));
  expect_error(
      model(components(twice), "shell"),
      "model.osim: Smith2018ContactMesh \"femur_cartilage\": there are several frames shell "
      "(from /contactgeometryset/femur_cartilage)");
  expect_error(
      model(components(frame("a", to("../b"), "") + frame("b", to("../a"), "")), kFemur + "/a"),
      "model.osim: PhysicalOffsetFrame \"a\": the frame ../b is fixed to itself");
}

}  // namespace
}  // namespace condyle
