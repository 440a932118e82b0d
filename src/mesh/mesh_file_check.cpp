#include "mesh/mesh_file_check.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "input_error.h"

namespace condyle {
namespace {

using std::string_view;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw InputError(fmt::format("{}: {}", file.string(), what));
}

std::string read_whole(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) fail(file, "mesh file not found");
  if (!std::filesystem::is_regular_file(file, error))
    fail(file, "expected a mesh file, found something else");
  std::ifstream stream(file, std::ios::binary);
  std::string bytes;
  const auto size = std::filesystem::file_size(file, error);
  if (!error) bytes.resize(size);
  if (!stream || error || !stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    fail(file, "mesh file cannot be read");
  if (bytes.empty()) fail(file, "mesh file is empty");
  return bytes;
}

/// Cuts text into words and lines, front to back.
struct Scanner {
  string_view rest;

  string_view line() {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const string_view result = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return result;
  }
  string_view word() {
    const char* blank = " \t\r\n\v\f";
    rest.remove_prefix(std::min(rest.find_first_not_of(blank), rest.size()));
    const string_view result = rest.substr(0, std::min(rest.find_first_of(blank), rest.size()));
    rest.remove_prefix(result.size());
    return result;
  }
};

std::optional<long> to_integer(string_view word) {
  long value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end == word.data()) return std::nullopt;
  return value;
}

/// The three coordinates that follow the keyword of a vertex line.
void check_coordinates(const std::filesystem::path& file, Scanner& line, long line_number) {
  for (int k = 0; k < 3; ++k) {
    const string_view word = line.word();
    if (word.empty()) fail(file, fmt::format("line {}: vertex lacks a coordinate", line_number));
    const string_view digits = word.substr(word.front() == '+' ? 1 : 0);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
      fail(file, fmt::format("line {}: vertex coordinate \"{}\", expected a finite number",
                             line_number, word));
  }
}

MeshFileCounts check_ascii_stl(const std::filesystem::path& file, string_view text) {
  long facets = 0, vertices = 0, closed = 0, line_number = 0;
  bool ended = false;
  for (Scanner scan{text}; !scan.rest.empty();) {
    Scanner line{scan.line()};
    ++line_number;
    const string_view key = line.word();
    if (key == "facet") ++facets;
    if (key == "vertex") {
      ++vertices;
      check_coordinates(file, line, line_number);
    }
    if (key == "endfacet") ++closed;
    if (key == "endsolid") ended = true;
  }
  if (facets == 0 && ended) fail(file, "mesh has no faces");
  if (!ended || facets != closed || vertices != 3 * facets)
    fail(file, fmt::format("ASCII STL is cut short: {} facets begun, {} ended, {} vertices{}",
                           facets, closed, vertices, ended ? "" : ", no endsolid"));
  return {.vertices = std::nullopt, .faces = facets};
}

MeshFileCounts check_stl(const std::filesystem::path& file, const std::string& bytes) {
  constexpr std::size_t kHeader = 84, kFacet = 50;
  std::uint32_t facets = 0;
  if (bytes.size() >= kHeader) std::memcpy(&facets, bytes.data() + 80, sizeof facets);
  const std::size_t expected = kHeader + kFacet * static_cast<std::size_t>(facets);
  const bool exact = bytes.size() >= kHeader && bytes.size() == expected;
  if (!exact && Scanner{bytes}.word() == "solid" && bytes.find('\0') == std::string::npos)
    return check_ascii_stl(file, bytes);
  if (bytes.size() < kHeader)
    fail(file, fmt::format("binary STL of {} bytes, expected at least {}", bytes.size(), kHeader));
  if (!exact)
    fail(file, fmt::format("binary STL states {} triangles = {} bytes, but the file holds {} bytes",
                           facets, expected, bytes.size()));
  if (facets == 0) fail(file, "mesh has no faces");
  return {.vertices = std::nullopt, .faces = facets};
}

/// Index of an OBJ face corner, "7", "7/1/3", "-1": 1-based, negative counts from the end.
void check_obj_corner(const std::filesystem::path& file,
                      string_view corner,
                      long vertices,
                      long line_number) {
  const std::optional<long> index = to_integer(corner);
  const bool known =
      index && ((*index >= 1 && *index <= vertices) || (*index <= -1 && *index >= -vertices));
  if (!known)
    fail(file, fmt::format("line {}: face refers to vertex \"{}\", expected 1 to {}", line_number,
                           corner, vertices));
}

MeshFileCounts check_obj(const std::filesystem::path& file, const std::string& bytes) {
  long vertices = 0;
  for (Scanner scan{bytes}; !scan.rest.empty();)
    if (scan.line().substr(0, 2) == "v ") ++vertices;
  long faces = 0, line_number = 0;
  for (Scanner scan{bytes}; !scan.rest.empty();) {
    Scanner line{scan.line()};
    ++line_number;
    if (line.rest.substr(0, 2) == "v ") {
      line.word();
      check_coordinates(file, line, line_number);
    }
    if (line.rest.substr(0, 2) != "f ") continue;
    line.word();
    int corners = 0;
    for (string_view c = line.word(); !c.empty(); c = line.word(), ++corners)
      check_obj_corner(file, c, vertices, line_number);
    if (corners < 3)
      fail(file,
           fmt::format("line {}: face with {} corners, expected at least 3", line_number, corners));
    ++faces;
  }
  if (vertices == 0) fail(file, "mesh has no vertices, expected lines \"v x y z\"");
  if (faces == 0) fail(file, "mesh has no faces");
  return {.vertices = std::nullopt, .faces = faces};
}

struct PlyElement {
  std::string name;
  long count = 0;
  std::size_t smallest =
      0;  ///< bytes of one entry in a binary file; a list counted with three items
};

std::size_t ply_size(string_view type) {
  static const std::map<string_view, std::size_t> kSizes = {
      {"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},  {"short", 2}, {"ushort", 2},
      {"int16", 2}, {"uint16", 2},  {"int", 4},    {"uint", 4},   {"int32", 4}, {"uint32", 4},
      {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = kSizes.find(type);
  return found == kSizes.end() ? 0 : found->second;
}

struct PlyHeader {
  bool binary = false;
  std::vector<PlyElement> elements;
  string_view body;
};

PlyHeader read_ply_header(const std::filesystem::path& file, const std::string& bytes) {
  Scanner scan{bytes};
  if (Scanner{scan.line()}.word() != "ply")
    fail(file, "not a PLY file: the first line must be \"ply\"");
  PlyHeader header;
  while (!scan.rest.empty()) {
    Scanner line{scan.line()};
    const string_view key = line.word();
    if (key == "format") header.binary = line.word() != "ascii";
    if (key == "element") {
      PlyElement element;
      element.name = line.word();
      element.count = to_integer(line.word()).value_or(-1);
      if (element.count < 0) fail(file, "PLY header: element without a count");
      header.elements.push_back(element);
    }
    if (key == "property") {
      if (header.elements.empty()) fail(file, "PLY header: property before any element");
      const string_view type = line.word();
      std::size_t& size = header.elements.back().smallest;
      if (type == "list") {
        size += ply_size(line.word());
        size += 3 * ply_size(line.word());
      } else {
        size += ply_size(type);
      }
    }
    if (key == "end_header") {
      header.body = scan.rest;
      return header;
    }
  }
  fail(file, "PLY header is cut short: no end_header");
}

MeshFileCounts check_ply(const std::filesystem::path& file, const std::string& bytes) {
  const PlyHeader header = read_ply_header(file, bytes);
  MeshFileCounts counts;
  long entries = 0;
  std::size_t smallest = 0;
  for (const PlyElement& e : header.elements) {
    if (e.name == "vertex") counts.vertices = e.count;
    if (e.name == "face") counts.faces = e.count;
    entries += e.count;
    smallest += e.smallest * static_cast<std::size_t>(e.count);
  }
  if (counts.vertices.value_or(0) == 0) fail(file, "mesh has no vertices");
  if (counts.faces.value_or(0) == 0) fail(file, "mesh has no faces");
  if (header.binary && header.body.size() < smallest)
    fail(file,
         fmt::format(
             "binary PLY is cut short: its header asks for at least {} bytes, the file holds {}",
             smallest, header.body.size()));
  if (!header.binary) {
    long lines = 0;
    for (Scanner scan{header.body}; !scan.rest.empty();)
      if (!Scanner{scan.line()}.word().empty()) ++lines;
    if (lines < entries)
      fail(file,
           fmt::format("ASCII PLY is cut short: its header asks for {} lines, the file holds {}",
                       entries, lines));
  }
  return counts;
}

MeshFileCounts check_off(const std::filesystem::path& file, const std::string& bytes) {
  std::vector<std::string> lines;  // without comments and blanks
  for (Scanner scan{bytes}; !scan.rest.empty();) {
    const string_view whole = scan.line();
    const string_view line = whole.substr(0, whole.find('#'));
    if (!Scanner{line}.word().empty()) lines.emplace_back(line);
  }
  if (lines.empty() || Scanner{lines[0]}.word().find("OFF") == string_view::npos)
    fail(file, "not an OFF file: the first word must be OFF");
  Scanner first{lines[0]};
  first.word();
  std::size_t next = 1;
  string_view word = first.word();
  Scanner counts_line = first;
  if (word.empty() && lines.size() > 1) {
    counts_line = Scanner{lines[next++]};
    word = counts_line.word();
  }
  const long vertices = to_integer(word).value_or(-1),
             faces = to_integer(counts_line.word()).value_or(-1);
  if (vertices < 0 || faces < 0)
    fail(file, "OFF: expected the numbers of vertices, faces and edges");
  if (vertices == 0) fail(file, "mesh has no vertices");
  if (faces == 0) fail(file, "mesh has no faces");
  if (static_cast<long>(lines.size() - next) < vertices + faces)
    fail(file,
         fmt::format("OFF is cut short: it states {} vertices and {} faces, but {} lines follow",
                     vertices, faces, lines.size() - next));
  for (long i = 0; i < faces; ++i) {
    Scanner line{lines[next + static_cast<std::size_t>(vertices + i)]};
    const long corners = to_integer(line.word()).value_or(0);
    if (corners < 3)
      fail(file, fmt::format("OFF: face {} has {} corners, expected at least 3", i, corners));
    for (long c = 0; c < corners; ++c) {
      const string_view index = line.word();
      const long k = to_integer(index).value_or(-1);
      if (k < 0 || k >= vertices)
        fail(file, fmt::format("OFF: face {} refers to vertex \"{}\", expected 0 to {}", i, index,
                               vertices - 1));
    }
  }
  return {.vertices = vertices, .faces = faces};
}

}  // namespace

MeshFileCounts check_mesh_file(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::string bytes = read_whole(file);
  if (extension == ".stl") return check_stl(file, bytes);
  if (extension == ".obj") return check_obj(file, bytes);
  if (extension == ".ply") return check_ply(file, bytes);
  if (extension == ".off") return check_off(file, bytes);
  fail(file,
       fmt::format("unsupported mesh format \"{}\", expected .stl, .ply, .obj or .off", extension));
}

}  // namespace condyle
