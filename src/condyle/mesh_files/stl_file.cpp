#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "condyle/mesh_files/mesh_readers.h"
#include "condyle/mesh_files/text_lines.h"
#include "condyle/mesh_files/vertex_index.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using std::string_view;

// Binary: a title, the number of facets, and for each a normal, three corners and two bytes.
constexpr std::size_t kTitle = 80, kHeader = 84, kFacet = 50, kNormal = 12, kCorner = 12;

/// A closed mesh has half as many vertices as triangles.
std::size_t expected_vertices(std::size_t triangles) { return triangles / 2 + triangles / 16; }

std::uint32_t word_at(const char* at) {
  std::uint32_t word = 0;
  for (int i = 3; i >= 0; --i) word = word << 8 | static_cast<unsigned char>(at[i]);
  return word;
}

Vector3d corner_at(const MeshBytes& bytes, std::size_t at) {
  Vector3d p;
  for (std::size_t k = 0; k < 3; ++k)
    p[static_cast<int>(k)] = std::bit_cast<float>(word_at(bytes.all().data() + at + 4 * k));
  if (!p.allFinite())
    bytes.fail(
        fmt::format("byte {}: triangle {} has a coordinate that is not a number (NaN or infinite)",
                    at, (at - kHeader) / kFacet));
  return p;
}

TriangleMesh read_binary(const MeshBytes& bytes, std::size_t facets) {
  if (facets == 0) bytes.fail("mesh has no faces");
  if (facets > static_cast<std::size_t>(std::numeric_limits<int>::max()) / 3)
    bytes.fail(fmt::format("{} triangles, expected at most {}", facets,
                           std::numeric_limits<int>::max() / 3));
  TriangleMesh mesh;
  mesh.triangles.resize(facets);
  VertexIndex index(mesh.vertices, expected_vertices(facets));
  for (std::size_t t = 0; t < facets; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      mesh.triangles[t][k] =
          index.number_of(corner_at(bytes, kHeader + kFacet * t + kNormal + kCorner * k));
  return mesh;
}

bool is_word(string_view word, string_view lower) {
  return std::equal(word.begin(), word.end(), lower.begin(), lower.end(), [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) == b;
  });
}

/// Solid by solid, facet by facet, each keyword in its place.
class AsciiStl {
 public:
  AsciiStl(const MeshBytes& bytes)
      : lines_(bytes, bytes.all(), {.name = "ASCII STL"}), index_(mesh_.vertices, 1000) {}

  TriangleMesh read() {
    lines_.next();
    do read_solid();
    while (lines_.next());
    return std::move(mesh_);
  }

 private:
  void read_solid() {
    expect("solid");
    std::string title;
    for (string_view w = lines_.word(); !w.empty(); w = lines_.word()) title.append(" ").append(w);
    lines_.expect_line_end();
    while (true) {
      next();
      const string_view key = lines_.word();
      if (is_word(key, "endsolid")) break;
      if (!is_word(key, "facet")) unexpected(key, "facet\" or \"endsolid");
      ++begun_;
      read_facet();
    }
    std::string end;
    for (string_view w = lines_.word(); !w.empty(); w = lines_.word()) end.append(" ").append(w);
    // The keyword ends the solid; a name that breaks off does not.
    if (!end.empty() && end != title) lines_.expect_line_end();
  }

  void read_facet() {
    lines_.skip_rest();  // the normal, which the triangle's corners tell better
    next();
    expect("outer");
    expect("loop");
    lines_.expect_end();
    std::array<int, 3> triangle{};
    for (int& v : triangle) {
      next();
      expect("vertex");
      v = index_.number_of(lines_.point("vertex coordinate"));
      lines_.expect_end();
      ++vertices_;
    }
    mesh_.triangles.push_back(triangle);
    for (const string_view key : {"endloop", "endfacet"}) {
      next();
      expect(key);
      lines_.expect_end();
    }
    ++ended_;
  }

  void next() {
    if (!lines_.next())
      lines_.fail_cut_short(fmt::format("{} facets begun, {} ended, {} vertices, no endsolid",
                                        begun_, ended_, vertices_));
  }
  void expect(string_view key) {
    const string_view word = lines_.word();
    if (!is_word(word, key)) unexpected(word, key);
  }
  [[noreturn]] void unexpected(string_view word, string_view key) {
    lines_.fail(fmt::format("\"{}\" in an ASCII STL, expected \"{}\"", quotable(word), key));
  }

  TextLines lines_;
  TriangleMesh mesh_;
  VertexIndex index_;
  long begun_ = 0, ended_ = 0, vertices_ = 0;
};

/// A title may begin with "solid" too: the size tells, then a byte 0, which no text holds.
bool is_ascii(string_view all) {
  const std::size_t first = all.find_first_not_of(" \t\r\n\v\f\xEF\xBB\xBF");
  return first != string_view::npos && is_word(all.substr(first, 5), "solid") &&
         all.find('\0') == string_view::npos;
}

}  // namespace

TriangleMesh read_stl(const MeshBytes& bytes) {
  const string_view all = bytes.all();
  const std::size_t facets = all.size() >= kHeader ? word_at(all.data() + kTitle) : 0;
  const std::size_t size = kHeader + kFacet * facets;
  if (all.size() >= kHeader && all.size() == size) return read_binary(bytes, facets);
  if (is_ascii(all)) {
    TriangleMesh mesh = AsciiStl(bytes).read();
    if (mesh.triangles.empty()) bytes.fail("mesh has no faces");
    return mesh;
  }
  if (all.size() < kHeader)
    bytes.fail(fmt::format("binary STL of {} bytes, expected at least {}", all.size(), kHeader));
  bytes.fail(fmt::format("binary STL states {} triangles = {} bytes, but the file holds {} bytes",
                         facets, size, all.size()));
}

}  // namespace condyle
