#include "condyle/mesh_files/load_mesh.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "condyle/input_error.h"
#include "condyle/mesh/clean_mesh.h"
#include "support/mesh_shapes.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

using namespace test;
namespace fs = std::filesystem;

/// A folder of its own for each test.
class LoadMesh : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::scratch_folder("condyle_mesh");
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  /// The message that loading ends with; empty where it succeeds.
  static std::string complaint(const fs::path& file, double to_mm = 1) {
    try {
      (void)load_mesh(file, to_mm);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  void expect_complaint(const std::string& name,
                        const std::string& bytes,
                        const std::string& part) {
    const std::string message = complaint(write(name, bytes));
    EXPECT_NE(message.find(part), std::string::npos) << name << ": " << message;
    EXPECT_NE(message.find(name), std::string::npos)
        << "the message must name the file: " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << "one line: " << message;
  }

  fs::path folder_;
};

std::string ascii_stl(const TriangleMesh& mesh) {
  std::ostringstream s;
  s << "solid cube\n";
  for (const auto& t : mesh.triangles) {
    s << "facet normal 0 0 0\n outer loop\n";
    for (const int v : t) s << "  vertex " << mesh.vertices[v].transpose() << "\n";
    s << " endloop\nendfacet\n";
  }
  s << "endsolid cube\n";
  return s.str();
}

std::string binary_stl(const TriangleMesh& mesh, const std::string& title = "") {
  std::string s = title + std::string(80 - title.size(), '\0');
  const auto put = [&s](const auto& value) {
    s.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) put(0.0f);
    for (const int v : t)
      for (int k = 0; k < 3; ++k) put(static_cast<float>(mesh.vertices[v][k]));
    put(static_cast<std::uint16_t>(0));
  }
  return s;
}

std::string obj(const TriangleMesh& mesh) {
  std::ostringstream s;
  for (const auto& v : mesh.vertices) s << "v " << v.transpose() << "\n";
  for (const auto& [a, b, c] : mesh.triangles)
    s << "f " << a + 1 << " " << b + 1 << " " << c + 1 << "\n";
  return s.str();
}

std::string off(const TriangleMesh& mesh) {
  std::ostringstream s;
  s << "OFF\n# a cube\n" << mesh.vertices.size() << " " << mesh.triangles.size() << " 0\n";
  for (const auto& v : mesh.vertices) s << v.transpose() << "\n";
  for (const auto& [a, b, c] : mesh.triangles) s << "3 " << a << " " << b << " " << c << "\n";
  return s.str();
}

// A vertex that no triangle has is no part of the bone, wherever it lies.
TEST_F(LoadMesh, AVertexOfNoTriangleSaysNothingAboutTheSize) {
  TriangleMesh mesh = cube(40);
  mesh.vertices.emplace_back(1e4, 1e4, 1e4);
  EXPECT_EQ(complaint(write("stray.obj", obj(mesh))), "");
  const CleanMesh clean = clean_mesh(mesh);
  EXPECT_EQ(clean.report.unreferenced_vertices, 1);
  EXPECT_EQ(clean.report.merged_vertices, 0);
}

std::string ply(const TriangleMesh& mesh, bool binary) {
  std::ostringstream s;
  s << "ply\nformat " << (binary ? "binary_little_endian" : "ascii") << " 1.0\nelement vertex "
    << mesh.vertices.size()
    << "\nproperty float x\nproperty float y\nproperty float z\nelement face "
    << mesh.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  const auto put = [&s](const auto& value) {
    s.write(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const auto& v : mesh.vertices) {
    if (binary)
      for (int k = 0; k < 3; ++k) put(static_cast<float>(v[k]));
    else
      s << v.transpose() << "\n";
  }
  for (const auto& t : mesh.triangles) {
    if (binary) {
      put(static_cast<unsigned char>(3));
      for (const int v : t) put(static_cast<std::int32_t>(v));
    } else {
      s << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
    }
  }
  return s.str();
}

// The same cube of 50 mm in every format: volume 125000 mm³, after merging 8 vertices.
TEST_F(LoadMesh, ReadsEveryFormat) {
  const TriangleMesh shape = cube(50);
  const std::pair<const char*, std::string> files[] = {
      {"a.stl", ascii_stl(shape)},
      {"b.stl", binary_stl(shape)},
      {"c.obj", obj(shape)},
      {"d.off", off(shape)},
      {"e.ply", ply(shape, false)},
      {"f.ply", ply(shape, true)},
      {"G.STL", binary_stl(shape, "solid of a scanner")}};
  for (const auto& [name, bytes] : files) {
    const CleanMesh clean = clean_mesh(load_mesh(write(name, bytes), 1));
    EXPECT_EQ(clean.mesh.vertices.size(), 8u) << name;
    EXPECT_EQ(clean.mesh.triangles.size(), 12u) << name;
    EXPECT_NEAR(enclosed_volume(clean.mesh), 125000, 1e-2) << name;  // assimp works in float
  }
}

TEST_F(LoadMesh, ConvertsToMillimetres) {
  const TriangleMesh mesh = load_mesh(write("metres.obj", obj(cube(0.05))), 1000);
  EXPECT_NEAR(enclosed_volume(mesh), 125000, 1e-1);
}

TEST_F(LoadMesh, CutsPolygonsIntoTriangles) {
  EXPECT_EQ(load_mesh(write("quad.obj", "v 0 0 0\nv 30 0 0\nv 30 30 0\nv 0 30 0\nf 1 2 3 4\n"), 1)
                .triangles.size(),
            2u);
}

TEST_F(LoadMesh, SaysWhatIsWrongWithAFile) {
  EXPECT_NE(complaint(folder_ / "nothing.stl").find("no such file, expected a mesh"),
            std::string::npos);
  EXPECT_NE(complaint(folder_).find("expected a mesh file"), std::string::npos);
  expect_complaint("empty.stl", "", "empty");
  expect_complaint("scan.vtk", "# vtk", "unsupported mesh format \".vtk\"");
  expect_complaint("noise.ply", "garbage", "not a PLY file");
  expect_complaint("noise.off", "garbage", "not an OFF file");
  expect_complaint("noise.obj", "garbage", "no vertices");
}

TEST_F(LoadMesh, RefusesFilesThatWereCutShort) {
  const TriangleMesh shape = cube(50);
  const auto half = [](const std::string& s) { return s.substr(0, s.size() * 2 / 3); };
  expect_complaint("half.stl", half(binary_stl(shape)),
                   "binary STL states 12 triangles = 684 bytes");
  expect_complaint("ascii.stl", half(ascii_stl(shape)), "ASCII STL");
  const std::string whole = ascii_stl(shape);
  const std::string at_a_facet = whole.substr(0, whole.find("facet normal", 400));
  expect_complaint("facet.stl", at_a_facet, "no endsolid");
  expect_complaint("half.ply", half(ply(shape, true)), "cut short");
  expect_complaint("ascii.ply", half(ply(shape, false)), "cut short");
  expect_complaint("half.off", half(off(shape)), "cut short");
  expect_complaint("header.ply", "ply\nformat ascii 1.0\n", "end_header");
  expect_complaint("line.obj", "v 0 0 0\nv 30 0 0\nv 0 30 0\nf 1 2", "corners");
}

TEST_F(LoadMesh, RefusesMeshesWithoutFaces) {
  expect_complaint("none.stl", "solid x\nendsolid x\n", "no faces");
  expect_complaint("none.obj", "v 0 0 0\nv 30 0 0\nv 0 30 0\n", "no faces");
  expect_complaint("none.off", "OFF\n3 0 0\n0 0 0\n30 0 0\n0 30 0\n", "no faces");
  expect_complaint("zero.stl", binary_stl({}), "no faces");
}

TEST_F(LoadMesh, RefusesIndicesThatPointNowhere) {
  expect_complaint("far.obj", "v 0 0 0\nv 30 0 0\nv 0 30 0\nf 1 2 4\n",
                   "line 4: face refers to vertex \"4\", expected 1 to 3");
  expect_complaint("far.off", "OFF\n3 1 0\n0 0 0\n30 0 0\n0 30 0\n3 0 1 7\n", "expected 0 to 2");
  TriangleMesh shape = cube(50);
  shape.triangles[4][1] = 99;
  expect_complaint("far.ply", ply(shape, true), "vertex that is not there");
}

TEST_F(LoadMesh, RefusesCoordinatesThatAreNoNumbers) {
  TriangleMesh shape = cube(50);
  shape.vertices[3].y() = std::nan("");
  expect_complaint("nan.stl", binary_stl(shape), "not a number");
  expect_complaint("nan.ply", ply(shape, true), "not a number");
  expect_complaint("nan.obj", obj(shape), "line 4: vertex coordinate \"nan\"");
  expect_complaint("word.stl",
                   "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9 0 a\n",
                   "line 5");
  expect_complaint("huge.obj", "v 0 0 0\nv 30 0 1e999\nv 0 30 0\nf 1 2 3\n", "1e999");
}

// A knee of 50 mm declared in the wrong unit is 50 m or 0.05 mm across.
TEST_F(LoadMesh, SuspectsTheUnitOfAMeshOfAbsurdSize) {
  const std::string large = complaint(write("large.stl", binary_stl(cube(50))), 1000);
  EXPECT_NE(large.find("a knee of 50 m?"), std::string::npos) << large;
  EXPECT_NE(large.find("look like mm"), std::string::npos) << large;
  const std::string small = complaint(write("small.stl", binary_stl(cube(0.05))), 1);
  EXPECT_NE(small.find("a knee of 0.05 mm?"), std::string::npos) << small;
  EXPECT_NE(small.find("look like m:"), std::string::npos) << small;
}

}  // namespace
}  // namespace condyle
