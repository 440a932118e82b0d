#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "condyle/mesh_files/mesh_readers.h"
#include "condyle/mesh_files/polygon_faces.h"
#include "condyle/mesh_files/text_lines.h"

namespace condyle {
namespace {

using std::string_view;

constexpr long kMost = std::numeric_limits<int>::max() / 3;

/// The first word: [ST][C][N]OFF. "4" and "n" stand for other dimensions than three.
void read_keyword(const MeshBytes& bytes, TextLines& lines) {
  if (!lines.next()) bytes.fail("not an OFF file: the first word must be OFF");
  string_view word = lines.word();
  for (const string_view prefix : {"ST", "C", "N"})
    if (word.substr(0, prefix.size()) == prefix) word.remove_prefix(prefix.size());
  if (word == "4OFF" || word == "nOFF" || word == "4nOFF")
    bytes.fail(
        fmt::format("\"{}\" holds points of other than three coordinates, expected OFF, "
                    "COFF, NOFF or STOFF",
                    word));
  if (word != "OFF") bytes.fail("not an OFF file: the first word must be OFF");
}

struct Counts {
  long vertices, faces;
};

/// On the line of the keyword or on the next one; the number of edges may be missing.
Counts read_counts(const MeshBytes& bytes, TextLines& lines) {
  string_view first = lines.peek();
  if (first.empty()) {
    if (!lines.next())
      bytes.fail("OFF is cut short: expected the numbers of vertices, faces and edges");
    first = lines.peek();
  }
  if (first == "BINARY") bytes.fail("binary OFF, expected ASCII: save it as text, or as PLY");
  const Counts counts = {lines.integer("number of vertices", 0, kMost),
                         lines.integer("number of faces", 0, kMost)};
  if (!lines.peek().empty()) (void)lines.integer("number of edges", 0, kMost);
  lines.expect_end();
  if (counts.vertices == 0) bytes.fail("mesh has no vertices");
  if (counts.faces == 0) bytes.fail("mesh has no faces");
  // A vertex takes six bytes at least ("0 0 0" and its end), a face eight.
  if (6 * counts.vertices + 8 * counts.faces > static_cast<long>(lines.bytes_left()) + 8)
    lines.fail_cut_short(fmt::format("it states {} vertices and {} faces, but {} bytes follow",
                                     counts.vertices, counts.faces, lines.bytes_left()));
  return counts;
}

void next(TextLines& lines, const Counts& counts, string_view what, long i) {
  if (!lines.next())
    lines.fail_cut_short(fmt::format("it states {} vertices and {} faces, but ends before {} {}",
                                     counts.vertices, counts.faces, what, i));
}

}  // namespace

TriangleMesh read_off(const MeshBytes& bytes) {
  TextLines lines(bytes, bytes.all(), {.name = "OFF", .comment = '#'});
  read_keyword(bytes, lines);
  const Counts counts = read_counts(bytes, lines);
  TriangleMesh mesh;
  mesh.vertices.reserve(static_cast<std::size_t>(counts.vertices));
  for (long i = 0; i < counts.vertices; ++i) {
    next(lines, counts, "vertex", i);
    mesh.vertices.push_back(lines.point("vertex coordinate"));
    lines.expect_line_end();  // behind the point: normal, colour, texture
  }
  PolygonFaces faces;
  faces.reserve(static_cast<std::size_t>(counts.faces));
  std::vector<int> corners;
  for (long i = 0; i < counts.faces; ++i) {
    next(lines, counts, "face", i);
    const long n = lines.integer("number of corners", 3, kMost);
    corners.clear();
    for (long c = 0; c < n; ++c)
      corners.push_back(static_cast<int>(lines.integer("vertex", 0, counts.vertices - 1)));
    lines.expect_line_end();  // behind the corners: colour
    faces.add(corners);
  }
  if (lines.next())
    lines.fail(fmt::format("the file goes on behind its {} vertices and {} faces", counts.vertices,
                           counts.faces));
  faces.move_to(mesh, bytes);
  return mesh;
}

}  // namespace condyle
