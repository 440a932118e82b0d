#include "mesh/made_mesh.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>

#include <fmt/format.h>

namespace condyle::test {
namespace {

using Eigen::Vector3d;

double number(Random& random, Numbers kind) {
  const double x = std::uniform_real_distribution<double>(-60, 60)(random);
  if (kind == Numbers::kWhole) return std::round(x);
  return kind == Numbers::kFloat ? static_cast<double>(static_cast<float>(x)) : x;
}

/// One of `choices`, the first one in plain files.
std::string free_choice(Random& random, const std::vector<std::string>& choices) {
  return random.plain ? choices[0] : one_of(random, choices);
}
/// What plain files never do, and others once in `n` times.
bool freely(Random& random, int n = 2) { return !random.plain && pick(random, 1, n) == 1; }

/// Words apart by one or more blanks.
std::string blank(Random& random) { return free_choice(random, {" ", " ", " ", "\t", "  "}); }

std::string line_end(Random& random) { return free_choice(random, {"\n", "\n", "\r\n", "\r"}); }

std::string decimal(Random& random, double x) {
  std::string text = coin(random) ? fmt::format("{}", x) : fmt::format("{:.17e}", x);
  return freely(random, 10) && x >= 0 && text[0] != '-' ? "+" + text : text;
}

std::string point(Random& random, const Vector3d& p) {
  return decimal(random, p.x()) + blank(random) + decimal(random, p.y()) + blank(random) +
         decimal(random, p.z());
}

/// Bytes of a value in either order.
void put_bits(std::string& bytes, std::uint64_t bits, int size, bool big_endian) {
  for (int i = 0; i < size; ++i)
    bytes.push_back(static_cast<char>(bits >> 8 * (big_endian ? size - 1 - i : i)));
}

/// Types of PLY: name, bytes, and 'i' signed, 'u' unsigned, 'f' floating.
struct Type {
  std::string name;
  int size;
  char kind;
};
const std::vector<Type>& types() {
  static const std::vector<Type> all = {
      {"char", 1, 'i'},  {"uchar", 1, 'u'},  {"short", 2, 'i'},   {"ushort", 2, 'u'},
      {"int", 4, 'i'},   {"uint", 4, 'u'},   {"float", 4, 'f'},   {"double", 8, 'f'},
      {"int8", 1, 'i'},  {"uint8", 1, 'u'},  {"int16", 2, 'i'},   {"uint16", 2, 'u'},
      {"int32", 4, 'i'}, {"uint32", 4, 'u'}, {"float32", 4, 'f'}, {"float64", 8, 'f'}};
  return all;
}
Type type_among(Random& random, const std::function<bool(const Type&)>& fits) {
  while (true)
    if (const Type& type = one_of(random, types()); fits(type)) return type;
}

/// Values in the body of a PLY.
class PlyBody {
 public:
  PlyBody(bool ascii, bool big_endian, std::string line_end)
      : ascii_(ascii), big_endian_(big_endian), line_end_(std::move(line_end)) {}
  void put(const Type& type, double x) {
    if (ascii_) {
      if (!begins_) bytes += " ";
      bytes += fmt::format("{}", x);
    } else if (type.kind == 'f') {
      put_bits(bytes,
               type.size == 4 ? std::bit_cast<std::uint32_t>(static_cast<float>(x))
                              : std::bit_cast<std::uint64_t>(x),
               type.size, big_endian_);
    } else {
      put_bits(bytes, static_cast<std::uint64_t>(static_cast<std::int64_t>(x)), type.size,
               big_endian_);
    }
    begins_ = false;
  }
  void end_entry() {
    if (ascii_) bytes += line_end_;
    begins_ = true;
  }
  std::string bytes;

 private:
  bool ascii_, big_endian_;
  std::string line_end_;
  bool begins_ = true;
};

/// A property that no reader asks for: a number, or a list.
struct Extra {
  Type type, count;
  bool is_list;

  explicit Extra(Random& random)
      : type(one_of(random, types())),
        count(type_among(random, [](const Type& t) { return t.kind != 'f'; })),
        is_list(pick(random, 0, 3) == 0) {}
  [[nodiscard]] std::string header(const std::string& name) const {
    return is_list ? "property list " + count.name + " " + type.name + " " + name
                   : "property " + type.name + " " + name;
  }
  void put(Random& random, PlyBody& body) const {
    const int n = is_list ? pick(random, 0, 4) : 1;
    if (is_list) body.put(count, n);
    for (int i = 0; i < n; ++i) body.put(type, pick(random, type.kind == 'i' ? -100 : 0, 100));
  }
};

std::vector<Extra> extras(Random& random) {
  std::vector<Extra> result;
  for (int n = random.plain ? 0 : pick(random, -2, 2); n > 0; --n) result.emplace_back(random);
  return result;
}

}  // namespace

MadeMesh make_mesh(Random& random, Numbers numbers, bool triangles_only) {
  MadeMesh mesh;
  const int n = pick(random, 4, 25);
  for (int i = 0; i < n; ++i)
    mesh.vertices.emplace_back(number(random, numbers), number(random, numbers),
                               number(random, numbers));
  for (int left = pick(random, 1, 12); left > 0; --left) {
    std::vector<int> face;
    const std::size_t corners =
        triangles_only || coin(random) ? 3 : pick(random, 4, random.plain ? 4 : 6);
    while (face.size() < std::min(corners, mesh.vertices.size()))
      if (const int v = pick(random, 0, n - 1);
          std::find(face.begin(), face.end(), v) == face.end())
        face.push_back(v);
    mesh.faces.push_back(face);
  }
  return mesh;
}

MadeFile make_ply(Random& random) {
  const bool ascii = pick(random, 0, 2) == 0, big_endian = coin(random);
  const Type real = one_of(random, std::vector<Type>{{"float", 4, 'f'},
                                                     {"double", 8, 'f'},
                                                     {"float64", 8, 'f'},
                                                     {"short", 2, 'i'},
                                                     {"int8", 1, 'i'}});
  const Numbers numbers = real.kind == 'i' ? Numbers::kWhole
                          : real.size == 4 ? Numbers::kFloat
                                           : Numbers::kDouble;
  MadeFile file{{}, make_mesh(random, numbers, false)};
  const std::string end = line_end(random);
  const auto integer = [](const Type& t) { return t.kind != 'f'; };
  const Type count = random.plain ? types()[1] : type_among(random, integer),
             index = random.plain ? types()[4] : type_among(random, integer);
  const auto before = extras(random), between = extras(random), after = extras(random),
             face_before = extras(random), face_after = extras(random), other = extras(random);
  const int others = pick(random, 0, 3), other_place = pick(random, 0, 2);
  const bool faces_first = freely(random, 6);

  PlyBody body(ascii, big_endian, end);
  std::string vertex = fmt::format("element vertex {}{}", file.mesh.vertices.size(), end),
              face = fmt::format("element face {}{}", file.mesh.faces.size(), end),
              rest = fmt::format("element other {}{}", others, end);
  int named = 0;
  const auto declare = [&](std::string& text, const std::vector<Extra>& list) {
    for (const Extra& e : list) text += e.header(fmt::format("p{}", named++)) + end;
  };
  declare(vertex, before);
  vertex += "property " + real.name + " x" + end;
  declare(vertex, between);
  vertex += "property " + real.name + " y" + end + "property " + real.name + " z" + end;
  declare(vertex, after);
  declare(face, face_before);
  face += "property list " + count.name + " " + index.name +
          (coin(random) ? " vertex_index" : " vertex_indices") + end;
  declare(face, face_after);
  declare(rest, other);
  rest += "property uchar last" + end;

  const auto put_all = [&](const std::vector<Extra>& list) {
    for (const Extra& e : list) e.put(random, body);
  };
  const auto put_vertices = [&] {
    for (const Vector3d& p : file.mesh.vertices) {
      put_all(before);
      body.put(real, p.x());
      put_all(between);
      body.put(real, p.y());
      body.put(real, p.z());
      put_all(after);
      body.end_entry();
    }
  };
  const auto put_faces = [&] {
    for (const auto& f : file.mesh.faces) {
      put_all(face_before);
      body.put(count, static_cast<double>(f.size()));
      for (const int v : f) body.put(index, v);
      put_all(face_after);
      body.end_entry();
    }
  };
  const auto put_others = [&] {
    for (int i = 0; i < others; ++i) {
      put_all(other);
      body.put({"uchar", 1, 'u'}, 10);
      body.end_entry();
    }
  };
  std::string header = "ply" + end + "format " +
                       (ascii        ? "ascii"
                        : big_endian ? "binary_big_endian"
                                     : "binary_little_endian") +
                       " 1.0" + end;
  if (coin(random)) header += "comment element vertex 7" + end + "obj_info made up" + end;
  const auto part = [&](int place) {
    if (random.plain || other_place != place) return;
    header += rest;
    put_others();
  };
  part(0);
  header += faces_first ? face : vertex;
  faces_first ? put_faces() : put_vertices();
  part(1);
  header += faces_first ? vertex : face;
  faces_first ? put_vertices() : put_faces();
  part(2);
  file.bytes = header + "end_header" + end + body.bytes;
  return file;
}

MadeFile make_stl(Random& random) {
  const bool ascii = coin(random);
  MadeMesh mesh = make_mesh(random, ascii ? Numbers::kDouble : Numbers::kFloat, true);
  MadeFile file;
  // The reader numbers vertices as they appear.
  std::map<std::tuple<double, double, double>, int> number;
  for (auto& face : mesh.faces)
    for (int& v : face) {
      const Vector3d& p = mesh.vertices[v];
      const auto [at, fresh] =
          number.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(file.mesh.vertices.size()));
      if (fresh) file.mesh.vertices.push_back(p);
      v = at->second;
    }
  file.mesh.faces = mesh.faces;
  const std::string title =
      one_of<std::string>(random, {"solid", "solid scan of a knee", "solid\nfacet", "made up", ""});
  if (!ascii) {
    file.bytes = title + std::string(80 - title.size(), coin(random) ? ' ' : '\0');
    put_bits(file.bytes, file.mesh.faces.size(), 4, false);
    for (const auto& face : file.mesh.faces) {
      put_bits(file.bytes, 0x7fc00000, 4, false);  // a normal that is no number
      put_bits(file.bytes, 0, 8, false);
      for (const int v : face)
        for (int k = 0; k < 3; ++k)
          put_bits(file.bytes,
                   std::bit_cast<std::uint32_t>(static_cast<float>(file.mesh.vertices[v][k])), 4,
                   false);
      put_bits(file.bytes, random(), 2, false);
    }
    return file;
  }
  const std::string end = line_end(random), indent(pick(random, 0, 4), ' ');
  const bool loud = freely(random, 5);
  const auto key = [loud](std::string text) {
    for (char& c : text) c = static_cast<char>(loud ? std::toupper(c) : c);
    return text;
  };
  file.bytes = key("solid") + " first" + end;
  for (std::size_t t = 0; t < file.mesh.faces.size(); ++t) {
    if (t > 0 && freely(random, 6)) {
      file.tells_its_end = false;
      file.bytes += key("endsolid") + " first" + end + end + key("solid") + " first" + end;
    }
    file.bytes += indent + key("facet normal") + " nan 0 1" + end + key("outer loop") + end;
    for (const int v : file.mesh.faces[t])
      file.bytes += indent + indent + key("vertex") + blank(random) +
                    point(random, file.mesh.vertices[v]) + end;
    file.bytes += key("endloop") + end + indent + key("endfacet") + end;
  }
  file.bytes += key("endsolid") + (coin(random) ? " first" : "") + end;
  return file;
}

MadeFile make_obj(Random& random) {
  MadeFile file{{}, make_mesh(random, Numbers::kDouble, false), false};
  const std::string end = line_end(random);
  const auto& vertices = file.mesh.vertices;
  const bool colours = freely(random), textures = freely(random);
  // Vertices in two halves, faces behind the half that has all of their vertices or at the end.
  const int half = static_cast<int>(vertices.size()) / 2;
  std::string& s = file.bytes;
  s = "# made up" + end + "mtllib knee.mtl" + end;
  const auto put_face = [&](const std::vector<int>& face, int known) {
    s += "f";
    for (const int v : face) {
      s += freely(random, 10) ? " \\" + end + " " : blank(random);
      s += std::to_string(coin(random) ? v + 1 : v - known);
      if (textures) s += one_of<std::string>(random, {"/1", "/1/1", "//1", ""});
    }
    s += (freely(random, 10) ? " # a face" : "") + end;
  };
  std::vector<std::vector<int>> early, late;
  for (const auto& face : file.mesh.faces)
    (*std::max_element(face.begin(), face.end()) < half ? early : late).push_back(face);
  for (int i = 0; i < static_cast<int>(vertices.size()); ++i) {
    if (i == half) {
      s += "vt 0 0" + end + "vn 0 0 1" + end + "g first" + end;
      for (const auto& face : early) put_face(face, half);
      s += "o second" + end + "s off" + end + "usemtl bone" + end;
    }
    s += "v" + blank(random) + point(random, vertices[i]);
    if (colours) s += " 0.5 0.25 1";
    s += end;
    if (pick(random, 0, 9) == 0) s += end;
  }
  for (const auto& face : late) put_face(face, static_cast<int>(vertices.size()));
  file.mesh.faces = early;
  file.mesh.faces.insert(file.mesh.faces.end(), late.begin(), late.end());
  return file;
}

MadeFile make_off(Random& random) {
  MadeFile file{{}, make_mesh(random, Numbers::kDouble, false)};
  const std::string end = line_end(random);
  const std::string key = free_choice(random, {"OFF", "COFF", "NOFF", "STOFF", "CNOFF", "STCNOFF"});
  std::string& s = file.bytes;
  s = key + (freely(random) ? " # made up" + end : end);
  if (freely(random)) s = "# a comment first" + end + end + s;
  if (freely(random, 4)) s = key + " ";
  s += fmt::format("{} {}{}{}", file.mesh.vertices.size(), file.mesh.faces.size(),
                   freely(random) ? "" : " 0", end);
  for (const Vector3d& p : file.mesh.vertices) {
    s += point(random, p);
    if (key.find('N') != std::string::npos) s += " 0 0 1";
    if (key.find('C') != std::string::npos) s += " 255 0 0 255";
    if (key.find("ST") != std::string::npos) s += " 0.5 0.5";
    s += end;
  }
  if (freely(random)) s += end + "# faces" + end;
  for (const auto& face : file.mesh.faces) {
    s += std::to_string(face.size());
    for (const int v : face) s += blank(random) + std::to_string(v);
    s += free_choice(random, {"", " 255 0 0", " 0.1 0.2 0.3 1", " 7", " # red"}) + end;
  }
  return file;
}

std::string difference(const TriangleMesh& mesh, const MadeMesh& expected) {
  if (mesh.vertices != expected.vertices) return "other vertices";
  std::size_t count = 0;
  Vector3d area = Vector3d::Zero(), expected_area = Vector3d::Zero();
  const auto add = [&](Vector3d& sum, int a, int b, int c) {
    const auto& v = expected.vertices;
    sum += (v[b] - v[a]).cross(v[c] - v[a]) / 2;
  };
  for (const auto& face : expected.faces) {
    for (std::size_t i = 2; i < face.size(); ++i) add(expected_area, face[0], face[i - 1], face[i]);
    if (face.size() == 3 && count < mesh.triangles.size() &&
        mesh.triangles[count] != std::array{face[0], face[1], face[2]})
      return fmt::format("triangle {} has other corners", count);
    count += face.size() - 2;
  }
  if (mesh.triangles.size() != count)
    return fmt::format("{} triangles, expected {}", mesh.triangles.size(), count);
  for (const auto& [a, b, c] : mesh.triangles) add(area, a, b, c);
  // Areas of up to 1e4 mm^2 each, of up to 48 triangles.
  if (!((area - expected_area).norm() < 1e-8)) return "another vector area";
  return "";
}

}  // namespace condyle::test
