#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "condyle/mesh_files/mesh_readers.h"
#include "condyle/mesh_files/polygon_faces.h"
#include "condyle/mesh_files/text_lines.h"

namespace condyle {
namespace {

using std::string_view;

/// Statements that say nothing about vertices and faces.
constexpr std::array<string_view, 44> kOthers = {
    "vn",   "vt",     "vp",     "p",          "l",         "g",      "o",        "s",
    "mg",   "usemtl", "mtllib", "usemap",     "maplib",    "bevel",  "c_interp", "d_interp",
    "lod",  "ctech",  "stech",  "shadow_obj", "trace_obj", "cstype", "deg",      "bmat",
    "step", "curv",   "curv2",  "surf",       "parm",      "trim",   "hole",     "scrv",
    "sp",   "end",    "con",    "call",       "csh",       "bsp",    "bzp",      "cdc",
    "cdp",  "res",    "vc",     "usemat"};

class ObjReader {
 public:
  explicit ObjReader(const MeshBytes& bytes)
      : bytes_(bytes),
        lines_(bytes, bytes.all(), {.name = "OBJ", .comment = '#', .continuation = true}) {}

  TriangleMesh read() {
    while (lines_.next()) read_statement(lines_.word());
    if (mesh_.vertices.empty()) bytes_.fail("mesh has no vertices, expected lines \"v x y z\"");
    if (!unknown_.empty()) bytes_.fail(unknown_);
    if (faces_.count() == 0) bytes_.fail("mesh has no faces");
    if (farthest_ >= static_cast<int>(mesh_.vertices.size()))
      bytes_.fail(fmt::format("line {}: face refers to vertex \"{}\", expected 1 to {}",
                              farthest_line_, farthest_ + 1, mesh_.vertices.size()));
    faces_.move_to(mesh_, bytes_);
    return std::move(mesh_);
  }

 private:
  void read_statement(string_view key) {
    if (key == "v") return read_vertex();
    if (key == "f" || key == "fo") return read_face();
    if (unknown_.empty() && std::find(kOthers.begin(), kOthers.end(), key) == kOthers.end())
      unknown_ =
          fmt::format("line {}: \"{}\" is no statement of an OBJ", lines_.line(), quotable(key));
    lines_.skip_rest();
  }

  /// x y z, then nothing, a weight, or a colour.
  void read_vertex() {
    if (mesh_.vertices.size() >= static_cast<std::size_t>(kMost))
      lines_.fail(fmt::format("expected at most {} vertices", kMost));
    mesh_.vertices.push_back(lines_.point("vertex coordinate"));
    std::vector<double>& rest = rest_;
    rest.clear();
    while (!lines_.peek().empty()) rest.push_back(lines_.number("number behind a vertex"));
    if (rest.size() == 1 && rest[0] != 1)
      lines_.fail(fmt::format("vertex has the weight {}, expected 1", rest[0]));
    lines_.expect_line_end();
  }

  void read_face() {
    corners_.clear();
    for (string_view w = lines_.word(); !w.empty(); w = lines_.word())
      corners_.push_back(corner(w));
    if (corners_.size() < 3)
      lines_.fail(fmt::format("face has {} corners, expected at least 3", corners_.size()));
    lines_.expect_line_end();
    if (faces_.count() >= static_cast<std::size_t>(kMost))
      lines_.fail(fmt::format("expected at most {} faces", kMost));
    faces_.add(corners_);
  }

  /// Index of "7", "7/1/3", "7//3", "-1": from 1, negative ones from the last vertex backwards.
  int corner(string_view text) {
    long index = 0;
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, index);
    const string_view rest(end, static_cast<std::size_t>(last - end));
    const bool whole = error == std::errc{} && (rest.empty() || rest.front() == '/') &&
                       rest.find_first_not_of("/-0123456789") == string_view::npos;
    const long known = static_cast<long>(mesh_.vertices.size());
    if (!whole || index == 0 || index < -known || index > kMost)
      lines_.fail(fmt::format("face refers to vertex \"{}\", expected {}1 to {}", quotable(text),
                              known == 0 ? "" : fmt::format("-{} to -1 or ", known),
                              known == 0 ? kMost : known));
    const int v = static_cast<int>(index > 0 ? index - 1 : known + index);
    if (v > farthest_) {
      farthest_ = v;
      farthest_line_ = lines_.line();
    }
    return v;
  }

  static constexpr long kMost = std::numeric_limits<int>::max() / 3;

  const MeshBytes& bytes_;
  TextLines lines_;
  TriangleMesh mesh_;
  PolygonFaces faces_;
  std::vector<int> corners_;
  std::vector<double> rest_;
  std::string unknown_;  ///< complaint about the first one
  int farthest_ = -1;    ///< greatest index that a face names
  long farthest_line_ = 0;
};

}  // namespace

TriangleMesh read_obj(const MeshBytes& bytes) { return ObjReader(bytes).read(); }

}  // namespace condyle
