#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "condyle/mesh_files/mesh_readers.h"
#include "condyle/mesh_files/ply_header.h"
#include "condyle/mesh_files/polygon_faces.h"
#include "condyle/mesh_files/text_lines.h"

namespace condyle {
namespace {

using std::string_view;

/// Values of an ASCII body: an entry stands on a line.
class TextValues {
 public:
  TextValues(const MeshBytes& bytes, const PlyHeader& header)
      : lines_(bytes, bytes.all().substr(header.begin), {.name = "ASCII PLY"}, header.lines + 1) {}

  void begin_entry(const PlyElement& element, long i) {
    if (!lines_.next())
      lines_.fail_cut_short(fmt::format("it states {} of element \"{}\", but ends before number {}",
                                        element.count, quotable(element.name), i));
  }
  void end_entry() { lines_.expect_end(); }
  double number(PlyType, string_view what) { return lines_.number(what); }
  long integer(PlyType, string_view what, long least, long greatest) {
    return lines_.integer(what, least, greatest);
  }
  void skip(PlyType, long count) {
    for (long i = 0; i < count; ++i)
      if (lines_.word().empty()) lines_.fail("a value is missing");
  }
  void end_of_elements() {
    if (lines_.next()) lines_.fail("the file goes on behind the elements that its header states");
  }
  [[noreturn]] void fail(string_view what) { lines_.fail(what); }
  void expect_room(const PlyElement& element) {
    // Every value takes a digit and a blank or line end.
    const auto least = 2 * element.properties.size() * static_cast<std::size_t>(element.count);
    if (lines_.bytes_left() + 1 < least)
      lines_.fail_cut_short(fmt::format("it states {} of element \"{}\", but {} bytes follow",
                                        element.count, quotable(element.name),
                                        lines_.bytes_left()));
  }

 private:
  TextLines lines_;
};

/// Values of a binary body.
class BinaryValues {
 public:
  BinaryValues(const MeshBytes& bytes, const PlyHeader& header)
      : bytes_(bytes),
        all_(bytes.all()),
        at_(header.begin),
        swapped_((header.encoding == PlyEncoding::kBigEndian) !=
                 (std::endian::native == std::endian::big)) {}

  void begin_entry(const PlyElement& element, long i) {
    element_ = &element;
    entry_ = i;
  }
  void end_entry() {}

  double number(PlyType type, string_view what) {
    const std::size_t at = at_;
    const double value = take(type);
    if (!std::isfinite(value))
      bytes_.fail(fmt::format("byte {}: {} of {} {} is not a number (NaN or infinite)", at, what,
                              quotable(element_->name), entry_));
    return value;
  }
  long integer(PlyType type, string_view what, long least, long greatest) {
    const std::size_t at = at_;
    const long value = static_cast<long>(take(type));  // 32 bits fit a double
    if (value < least || value > greatest)
      bytes_.fail(fmt::format("byte {}: {} {} of {} {}, expected {} to {}", at, what, value,
                              quotable(element_->name), entry_, least, greatest));
    return value;
  }
  void skip(PlyType type, long count) {
    const std::size_t size = size_of(type) * static_cast<std::size_t>(count);
    expect(size);
    at_ += size;
  }
  /// Nothing may follow but blanks or zeros, which some programs fill up with.
  void end_of_elements() {
    const string_view rest = all_.substr(at_);
    if (rest.find_first_not_of(string_view("\0 \t\r\n", 5)) != string_view::npos)
      bytes_.fail(fmt::format(
          "byte {}: the file goes on for {} bytes behind the elements that its header states", at_,
          rest.size()));
  }
  [[noreturn]] void fail(string_view what) { bytes_.fail(fmt::format("byte {}: {}", at_, what)); }
  void expect_room(const PlyElement& element) {
    const std::size_t least = element.least_bytes() * static_cast<std::size_t>(element.count);
    if (all_.size() - at_ < least)
      bytes_.fail(
          fmt::format("binary PLY is cut short: its header asks for at least {} bytes of "
                      "element \"{}\", the file holds {}",
                      least, quotable(element.name), all_.size() - at_));
  }

 private:
  void expect(std::size_t size) {
    if (all_.size() - at_ < size)
      bytes_.fail(
          fmt::format("byte {}: binary PLY is cut short in number {} of {} of element \"{}\"", at_,
                      entry_, element_->count, quotable(element_->name)));
  }

  template <class Bits>
  Bits take_bits() {
    expect(sizeof(Bits));
    Bits bits;
    std::memcpy(&bits, all_.data() + at_, sizeof(Bits));
    at_ += sizeof(Bits);
    if constexpr (sizeof(Bits) == 2) return swapped_ ? __builtin_bswap16(bits) : bits;
    if constexpr (sizeof(Bits) == 4) return swapped_ ? __builtin_bswap32(bits) : bits;
    if constexpr (sizeof(Bits) == 8) return swapped_ ? __builtin_bswap64(bits) : bits;
    return bits;
  }

  double take(PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return static_cast<std::int8_t>(take_bits<std::uint8_t>());
      case PlyType::kUint8:
        return take_bits<std::uint8_t>();
      case PlyType::kInt16:
        return static_cast<std::int16_t>(take_bits<std::uint16_t>());
      case PlyType::kUint16:
        return take_bits<std::uint16_t>();
      case PlyType::kInt32:
        return static_cast<std::int32_t>(take_bits<std::uint32_t>());
      case PlyType::kUint32:
        return take_bits<std::uint32_t>();
      case PlyType::kFloat:
        return std::bit_cast<float>(take_bits<std::uint32_t>());
      case PlyType::kDouble:
        break;
    }
    return std::bit_cast<double>(take_bits<std::uint64_t>());
  }

  const MeshBytes& bytes_;
  string_view all_;
  std::size_t at_;
  bool swapped_;
  const PlyElement* element_ = nullptr;
  long entry_ = 0;
};

constexpr long kMostItems = 1L << 30;  // of a list

template <class Values>
void skip_property(Values& values, const PlyProperty& property) {
  const long count =
      property.count ? values.integer(*property.count, "number of items", 0, kMostItems) : 1;
  values.skip(property.type, count);
}

/// Which coordinate each property is; -1: none.
std::vector<int> coordinates(const MeshBytes& bytes, const PlyElement& element) {
  std::vector<int> axis(element.properties.size(), -1);
  constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    const auto at = element.find(kNames[k]);
    if (!at || element.properties[*at].count)
      bytes.fail(fmt::format(
          "PLY header: element vertex has no number \"{}\", expected properties x, y and z",
          kNames[k]));
    axis[*at] = k;
  }
  return axis;
}

template <class Values>
void read_vertices(const MeshBytes& bytes,
                   const PlyElement& element,
                   Values& values,
                   TriangleMesh& mesh) {
  const std::vector<int> axis = coordinates(bytes, element);
  mesh.vertices.resize(static_cast<std::size_t>(element.count));
  for (long i = 0; i < element.count; ++i) {
    values.begin_entry(element, i);
    for (std::size_t k = 0; k < axis.size(); ++k)
      if (axis[k] < 0)
        skip_property(values, element.properties[k]);
      else
        mesh.vertices[i][axis[k]] = values.number(element.properties[k].type, "vertex coordinate");
    values.end_entry();
  }
}

/// The list of corners of a face.
std::size_t corner_list(const MeshBytes& bytes, const PlyElement& element) {
  auto list = element.find("vertex_indices");
  if (!list) list = element.find("vertex_index");
  if (!list || !element.properties[*list].count || !is_integer(element.properties[*list].type))
    bytes.fail("PLY header: element face has no list of integers vertex_indices");
  return *list;
}

template <class Values>
void read_faces(const MeshBytes& bytes,
                const PlyElement& element,
                long vertices,
                Values& values,
                PolygonFaces& faces) {
  const std::size_t list = corner_list(bytes, element);
  faces.reserve(static_cast<std::size_t>(element.count));
  std::vector<int> corners;
  for (long i = 0; i < element.count; ++i) {
    values.begin_entry(element, i);
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const PlyProperty& property = element.properties[k];
      if (k != list) {
        skip_property(values, property);
        continue;
      }
      const long n = values.integer(*property.count, "number of corners", 3, kMostItems);
      corners.clear();
      for (long c = 0; c < n; ++c) {
        const long v = values.integer(property.type, "vertex", std::numeric_limits<long>::min(),
                                      std::numeric_limits<long>::max());
        if (v < 0 || v >= vertices)
          values.fail(
              fmt::format("face {} refers to vertex {}, a vertex that is not there: expected "
                          "0 to {}",
                          i, v, vertices - 1));
        corners.push_back(static_cast<int>(v));
      }
      faces.add(corners);
    }
    values.end_entry();
  }
}

template <class Values>
TriangleMesh read_elements(const MeshBytes& bytes, const PlyHeader& header, Values values) {
  long vertices = 0, face_count = 0;
  for (const PlyElement& e : header.elements) {
    if (e.name == "vertex") vertices = e.count;
    if (e.name == "face") face_count = e.count;
  }
  if (vertices == 0) bytes.fail("mesh has no vertices");
  if (face_count == 0) bytes.fail("mesh has no faces");
  TriangleMesh mesh;
  PolygonFaces faces;
  for (const PlyElement& element : header.elements) {
    values.expect_room(element);
    if (element.name == "vertex") {
      read_vertices(bytes, element, values, mesh);
    } else if (element.name == "face") {
      read_faces(bytes, element, vertices, values, faces);
    } else if (!element.properties.empty()) {
      for (long i = 0; i < element.count; ++i) {
        values.begin_entry(element, i);
        for (const PlyProperty& property : element.properties) skip_property(values, property);
        values.end_entry();
      }
    }
  }
  values.end_of_elements();
  faces.move_to(mesh, bytes);
  return mesh;
}

}  // namespace

TriangleMesh read_ply(const MeshBytes& bytes) {
  const PlyHeader header = read_ply_header(bytes);
  return header.encoding == PlyEncoding::kAscii
             ? read_elements(bytes, header, TextValues(bytes, header))
             : read_elements(bytes, header, BinaryValues(bytes, header));
}

}  // namespace condyle
