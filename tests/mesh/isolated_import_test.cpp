#include "condyle/mesh_files/isolated_import.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <filesystem>
#include <fstream>

#include "condyle/input_error.h"
#include "condyle/mesh_files/load_mesh.h"
#include "condyle/mesh_files/mesh_readers.h"
#include "mesh/made_mesh.h"
#include "support/mesh_shapes.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

using namespace test;
namespace fs = std::filesystem;
using Eigen::Vector3d;

class IsolatedImport : public ::testing::Test {
 protected:
  void SetUp() override { folder_ = test::fresh_folder("condyle_import"); }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  static std::string complaint(const fs::path& file, const ChildLimits& limits = {}) {
    try {
      (void)import_isolated(file, limits);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  fs::path folder_;
};

/// Corner points of triangles, one after the other: what is left when vertices are numbered anew.
std::vector<Vector3d> corner_points(const TriangleMesh& mesh) {
  std::vector<Vector3d> points;
  for (const auto& triangle : mesh.triangles)
    for (const int v : triangle) points.push_back(mesh.vertices[v]);
  return points;
}

Eigen::AlignedBox3d bounds(const std::vector<Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& p : points) box.extend(p);
  return box;
}

Vector3d vector_area(const std::vector<Vector3d>& corners) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    sum += (corners[i + 1] - corners[i]).cross(corners[i + 2] - corners[i]) / 2;
  return sum;
}

struct Witnessed {
  const char* ending;
  MadeFile (*make)(Random&);
  TriangleMesh (*read)(const MeshBytes&);
};

// assimp as an independent witness, on files that use only what every program reads alike: the
// same triangles, to the seven digits it keeps. On the other made-up files it drops faces, loops or
// crashes (docs/mesh.md).
TEST_F(IsolatedImport, AgreesWithTheReaders) {
  const Witnessed formats[] = {{".stl", make_stl, read_stl},
                               {".ply", make_ply, read_ply},
                               {".obj", make_obj, read_obj},
                               {".off", make_off, read_off}};
  for (const Witnessed& format : formats) {
    Random random(5);
    random.plain = true;
    for (int i = 0; i < 40; ++i) {
      const MadeFile made = format.make(random);
      const fs::path file = write(std::string("made") + format.ending, made.bytes);
      const auto ours = corner_points(format.read(MeshBytes(file))),
                 theirs = corner_points(import_isolated(file));
      ASSERT_EQ(ours.size(), theirs.size()) << made.bytes;
      const auto a = bounds(ours), b = bounds(theirs);
      EXPECT_LT((a.min() - b.min()).norm() + (a.max() - b.max()).norm(), 1e-5) << made.bytes;
      // Of up to 24 triangles with sides of 100 mm; a quadrilateral may be cut either way.
      EXPECT_LT((vector_area(ours) - vector_area(theirs)).norm(), 1e-2) << made.bytes;
    }
  }
}

const char* const kPart =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
    "\"nodes\":[{\"mesh\":0,\"translation\":[100,0,0],\"scale\":[2,2,2]}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
    "\"min\":[0,0,0],\"max\":[10,10,0]}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"triangle.bin\"}]}";

std::string triangle_of_10_mm() {
  std::string data;
  for (const float x : {0.f, 0.f, 0.f, 10.f, 0.f, 0.f, 0.f, 10.f, 0.f})
    data.append(reinterpret_cast<const char*>(&x), sizeof x);
  return data;
}

// Nodes of a scene move their meshes: a triangle of 10 mm, doubled and moved by 100 mm.
TEST_F(IsolatedImport, ReadsGltfWithItsTransforms) {
  write("triangle.bin", triangle_of_10_mm());
  const TriangleMesh mesh = load_mesh(write("triangle.gltf", kPart), 1);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  const auto box = bounds(mesh.vertices);
  EXPECT_NEAR((box.min() - Vector3d(100, 0, 0)).norm(), 0, 1e-4);
  EXPECT_NEAR((box.max() - Vector3d(120, 20, 0)).norm(), 0, 1e-4);
}

// No file can be opened any more, so there is no pipe to a process.
TEST_F(IsolatedImport, WithoutAProcessSaysSo) {
  const fs::path file = write("triangle.gltf", kPart);
  rlimit files{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &files), 0);
  const rlimit none{3, files.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &none), 0);
  const std::string said = complaint(file);
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &files), 0);
  EXPECT_EQ(said, file.string() +
                      ": mesh cannot be read: no process can be started for it: Too many open "
                      "files");
}

// Numbers of other files are none of a mesh's: neither by a path nor by a link.
TEST_F(IsolatedImport, ReadsNoPartsFromElsewhere) {
  const fs::path inner = folder_ / "inner";
  fs::create_directories(inner);
  write("triangle.bin", triangle_of_10_mm());
  const auto named = [&](const std::string& uri) {
    std::string text = kPart;
    text.replace(text.find("triangle.bin"), 12, uri);
    return write("inner/triangle.gltf", text);
  };
  fs::create_symlink(folder_ / "triangle.bin", inner / "link.bin");
  for (const std::string& uri : {std::string("../triangle.bin"),
                                 (folder_ / "triangle.bin").string(), std::string("link.bin")})
    EXPECT_NE(complaint(named(uri)).find("mesh cannot be read: "), std::string::npos) << uri;
  fs::copy_file(folder_ / "triangle.bin", inner / "own.bin");
  EXPECT_EQ(load_mesh(named("own.bin"), 1).triangles.size(), 1u);
}

TEST_F(IsolatedImport, RefusesInOneLine) {
  const std::string message = complaint(write("noise.dae", "garbage\n\n"));
  EXPECT_NE(message.find("mesh cannot be read: "), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

std::string ply_beginning_with_line_feed() {
  std::string s =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  s.push_back('\n');
  return s + std::string(35, '\0') + '\3' + std::string(12, '\0');
}

// assimp 5.2.5 takes the first byte of the data for a line end and reads beyond the last one:
// this process goes on, with a mesh from a version that does better, or one line.
TEST_F(IsolatedImport, OutlivesAnImporterThatDies) {
  const std::string message = complaint(write("feed.ply", ply_beginning_with_line_feed()));
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  if (!message.empty()) {
    EXPECT_NE(message.find("feed.ply: mesh cannot be read: "), std::string::npos) << message;
  }
}

TEST_F(IsolatedImport, KeepsToItsLimits) {
  std::string obj;
  for (int i = 0; i < 300000; ++i) obj += "v 1 2 3\nf -1 -1 -1\n";
  const fs::path file = write("large.obj", obj);
  EXPECT_NE(complaint(file, {.seconds = 0.02}).find("the importer stopped on it"),
            std::string::npos);
#ifndef __SANITIZE_ADDRESS__
  EXPECT_NE(complaint(file, {.memory = 1e7}), "");
#endif
}

}  // namespace
}  // namespace condyle
