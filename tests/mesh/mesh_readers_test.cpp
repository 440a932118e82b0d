#include "condyle/mesh_files/mesh_readers.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "condyle/input_error.h"
#include "condyle/mesh_files/polygon_faces.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

using Reader = TriangleMesh (*)(const MeshBytes&);

TriangleMesh read(Reader reader, const std::string& text) {
  return reader(MeshBytes("knee", text));
}

std::string complaint(Reader reader, const std::string& text) {
  try {
    (void)read(reader, text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

void expect_complaint(Reader reader, const std::string& text, const std::string& part) {
  const std::string message = complaint(reader, text);
  EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_EQ(message.rfind("knee: ", 0), 0u) << message;
}

std::string bytes_of(std::uint64_t bits, int size, bool big_endian = false) {
  std::string result;
  for (int i = 0; i < size; ++i)
    result.push_back(static_cast<char>(bits >> 8 * (big_endian ? size - 1 - i : i)));
  return result;
}
std::string bytes_of(float x) { return bytes_of(std::bit_cast<std::uint32_t>(x), 4); }

/// One triangle whose first coordinate is given by its bytes.
std::string binary_ply(const std::string& end, const std::string& x) {
  std::string s = "ply" + end + "format binary_little_endian 1.0" + end + "element vertex 3" + end;
  for (const char* name : {"x", "y", "z"}) s += "property float " + std::string(name) + end;
  s += "element face 1" + end + "property list uchar int vertex_indices" + end + "end_header" + end;
  s += x;
  for (const float c : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) s += bytes_of(c);
  return s + bytes_of(3, 1) + bytes_of(0, 4) + bytes_of(1, 4) + bytes_of(2, 4);
}

// The line end of the header is fixed by its first line; the data begin right behind the last one,
// whatever they look like. assimp 5.2.5 crashes on 0x0A.
TEST(PlyFile, DataMayBeginWithAnyByte) {
  for (const char* end : {"\n", "\r\n", "\r"})
    for (unsigned byte = 0; byte < 256; ++byte) {
      const std::uint32_t bits = 0x40000000u | byte;  // near 2
      const TriangleMesh mesh = read(read_ply, binary_ply(end, bytes_of(bits, 4)));
      ASSERT_EQ(mesh.vertices.size(), 3u);
      EXPECT_EQ(mesh.vertices[0].x(), std::bit_cast<float>(bits)) << byte;
      EXPECT_EQ(mesh.vertices[2], Vector3d(0, 1, 0));
    }
}

TEST(PlyFile, KeepsAllDigitsOfADouble) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
      "property double z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
      "1600.0000000012345 0 0\n0 1 0\n0 0 1\n3 0 1 2\n";
  EXPECT_EQ(read(read_ply, text).vertices[0].x(), 1600.0000000012345);
}

std::string ascii_ply(const std::string& properties, const std::string& body) {
  return "ply\nformat ascii 1.0\nelement vertex 3\n" + properties +
         "element face 1\nproperty list uchar int vertex_indices\nend_header\n" + body;
}

TEST(ObjFile, ANumberBeyondAllDoublesIsRefusedAndOneBelowThemIsNone) {
  const std::string body = "\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const std::string ones(400, '1'), zeros(400, '0');
  for (const std::string& x : {ones, "-" + ones + ".5", "1" + zeros + "e-50", std::string("1e400"),
                               "0.001e+" + ones, std::string("5e309"), ones + "e"})
    expect_complaint(read_obj, "v " + x + " 0 0" + body, "expected a finite number");
  for (const std::string& x :
       {std::string("1e-400"), "0." + zeros + "1", "1" + zeros + "e-800", "-1e-" + ones,
        "0." + zeros + zeros + "7e+300", std::string("0e999")}) {
    const TriangleMesh mesh = read(read_obj, "v " + x + " 0 0" + body);
    EXPECT_EQ(mesh.vertices[0].x(), 0) << x;
  }
  expect_complaint(read_obj, "v " + ones + "e", "finite number");  // the file ends there
}

TEST(PlyFile, SaysWhatIsWrong) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\n",
                    body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(complaint(read_ply, ascii_ply(xyz, body)), "");
  expect_complaint(read_ply, ascii_ply("property float x\nproperty float y\n", body),
                   "no number \"z\"");
  expect_complaint(read_ply, ascii_ply(xyz, "0 0 0\n1 0 0\n0 1 0\n3 0 1 2"),
                   "line 13: the last line has no line end (ASCII PLY is cut short)");
  expect_complaint(read_ply, ascii_ply(xyz, "0 0 0\n1 0\n0 1 0\n3 0 1 2\n"),
                   "line 11: vertex coordinate is missing");
  expect_complaint(read_ply, ascii_ply(xyz, "0 0 0\n1 0 0 5\n0 1 0\n3 0 1 2\n"),
                   "line 11: \"5\" follows, expected the end of the line");
  expect_complaint(read_ply, ascii_ply(xyz, body + "3 0 1 2\n"), "line 14: the file goes on");
  expect_complaint(read_ply, ascii_ply(xyz, "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
                   "vertex that is not there: expected 0 to 2");
  expect_complaint(read_ply, ascii_ply(xyz + "property flaot w\n", body),
                   "line 7: PLY header: type \"flaot\"");
  expect_complaint(read_ply, ascii_ply(xyz + "property float x\n", body), "a second property");
  const std::string binary = binary_ply("\n", bytes_of(1.f));
  expect_complaint(read_ply, binary.substr(0, binary.size() - 1), "cut short in number 0 of 1");
  expect_complaint(read_ply, binary + "more", "the file goes on for 4 bytes");
  expect_complaint(read_ply, binary_ply("\n", bytes_of(0x7fc00000, 4)),
                   "vertex coordinate of vertex 0 is not a number");
  expect_complaint(read_ply, "ply\nformat ascii 1.0\nelement vertex 4000000000\nend_header\n",
                   "element without a count");
  expect_complaint(read_ply,
                   "ply\nformat ascii 1.0\nelement vertex 600000000\n" + xyz +
                       "element face 1\nproperty list uchar int vertex_indices\nend_header\n",
                   "cut short");
}

TEST(StlFile, SharesEqualVertices) {
  std::string text = "solid\n";
  for (const char* last : {"0 1 0", "0 -1 0"})
    text += std::string("facet normal 0 0 1\nouter loop\nvertex -0 0 0\nvertex 1 0 0\nvertex ") +
            last + "\nendloop\nendfacet\n";
  const TriangleMesh mesh = read(read_stl, text + "endsolid\n");
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.triangles[1], (std::array<int, 3>{0, 1, 3}));
}

TEST(StlFile, SaysWhatIsWrong) {
  const std::string head = "solid a knee\nfacet normal 0 0 1\nouter loop\n",
                    tail = "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a knee";
  EXPECT_EQ(complaint(read_stl, head + "vertex 0 0 0\n" + tail), "");  // the last word is whole
  expect_complaint(read_stl, head + "vertex 0 0 0\n" + tail.substr(0, tail.size() - 1),
                   "the last line has no line end");
  expect_complaint(read_stl, head + "vertex 0 0\n" + tail + "\n",
                   "line 4: vertex coordinate is missing");
  expect_complaint(read_stl, head + "vertex 0 0 0\nvertex 0 0 0\n" + tail + "\n",
                   "line 7: \"vertex\" in an ASCII STL, expected \"endloop\"");
}

TEST(ObjFile, SaysWhatIsWrong) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(complaint(read_obj, v + "f -3 -2 -1\n"), "");
  EXPECT_EQ(complaint(read_obj, "f 1 2 3\n" + v), "");  // forward
  expect_complaint(read_obj, v + "f 1 2 3", "the last line has no line end");
  expect_complaint(read_obj, v + "f -4 -2 -1\n", "line 4: face refers to vertex \"-4\"");
  expect_complaint(read_obj, v + "f 1 2 0\n", "line 4: face refers to vertex \"0\"");
  expect_complaint(read_obj, v + "f 1 2 3x\n", "line 4: face refers to vertex \"3x\"");
  expect_complaint(read_obj, v + "f 1 2 3\nvv 1 2 3\n", "line 5: \"vv\" is no statement");
  expect_complaint(read_obj, v + "v 0 0 1 2\nf 1 2 3\n", "line 4: vertex has the weight 2");
  expect_complaint(read_obj, v + "f 1 2 \\", "the file ends here");
}

TEST(OffFile, SaysWhatIsWrong) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(complaint(read_off, "OFF 3 1 0\n" + body), "");
  expect_complaint(read_off, "OFF BINARY\n" + body, "binary OFF, expected ASCII");
  expect_complaint(read_off, "4OFF\n3 1 0\n" + body, "\"4OFF\" holds points of other than three");
  expect_complaint(read_off, "OFF\n3 1 0\n" + body + "3 0 1 2\n", "line 7: the file goes on");
  expect_complaint(read_off, "OFF\n3 x 0\n" + body, "line 2: number of faces \"x\"");
  expect_complaint(read_off, "OFF\n600000000 600000000 0\n" + body, "OFF is cut short");
}

// An L of five unit squares in a row of three and a column of three: only ears inside it count.
TEST(Polygon, ThatIsNotConvexIsCutInside) {
  const std::vector<Vector3d> corners = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0},
                                         {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  for (std::size_t first = 0; first < corners.size(); ++first) {
    std::vector<Vector3d> turned;
    for (std::size_t i = 0; i < corners.size(); ++i)
      turned.push_back(corners[(first + i) % corners.size()]);
    std::vector<std::array<int, 3>> triangles;
    std::int64_t work = 1000;
    ASSERT_TRUE(triangulate(turned, triangles, work));
    EXPECT_LT(work, 1000);
    std::int64_t none = 3;
    EXPECT_FALSE(triangulate(turned, triangles, none));
    ASSERT_TRUE(triangulate(turned, triangles, work));
    ASSERT_EQ(triangles.size(), 4u);
    double area = 0;
    for (const auto& [a, b, c] : triangles) {
      const double part = (turned[b] - turned[a]).cross(turned[c] - turned[a]).z() / 2;
      EXPECT_GE(part, 0);
      area += part;
    }
    EXPECT_NEAR(area, 5, 1e-12);
  }
}

// A dart: the fan from the first corner would lie outside.
TEST(Polygon, AQuadWithADentIsCutAtTheDent) {
  const std::vector<Vector3d> dart = {{-2, -1, 5}, {0, 3, 5}, {2, -1, 5}, {0, 0, 5}};
  std::vector<std::array<int, 3>> triangles;
  std::int64_t work = 100;
  ASSERT_TRUE(triangulate(dart, triangles, work));
  double area = 0;
  for (const auto& [a, b, c] : triangles)
    area += (dart[b] - dart[a]).cross(dart[c] - dart[a]).norm() / 2;
  EXPECT_NEAR(area, 6, 1e-12);  // of the triangle 4 x 4 / 2 without the notch 4 x 1 / 2
}

}  // namespace
}  // namespace condyle
