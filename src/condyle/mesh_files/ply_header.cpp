#include "condyle/mesh_files/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace condyle {
namespace {

using std::string_view;

std::optional<PlyType> type_of(string_view name) {
  constexpr std::array<std::pair<string_view, PlyType>, 16> kTypes = {
      {{"char", PlyType::kInt8},
       {"int8", PlyType::kInt8},
       {"uchar", PlyType::kUint8},
       {"uint8", PlyType::kUint8},
       {"short", PlyType::kInt16},
       {"int16", PlyType::kInt16},
       {"ushort", PlyType::kUint16},
       {"uint16", PlyType::kUint16},
       {"int", PlyType::kInt32},
       {"int32", PlyType::kInt32},
       {"uint", PlyType::kUint32},
       {"uint32", PlyType::kUint32},
       {"float", PlyType::kFloat},
       {"float32", PlyType::kFloat},
       {"double", PlyType::kDouble},
       {"float64", PlyType::kDouble}}};
  for (const auto& [known, type] : kTypes)
    if (name == known) return type;
  return std::nullopt;
}

/// Line by line; the first line tells how lines end: LF, CRLF, or CR alone.
class HeaderReader {
 public:
  explicit HeaderReader(const MeshBytes& bytes) : bytes_(bytes), all_(bytes.all()) {}

  PlyHeader read() {
    const std::size_t first = all_.find_first_of("\r\n");
    if (all_.substr(0, 3) != "ply" || first == string_view::npos ||
        all_.substr(3, first - 3).find_first_not_of(" \t") != string_view::npos)
      bytes_.fail("not a PLY file: the first line must be \"ply\"");
    // A lone CR; before LF it belongs to the line's end.
    if (all_[first] == '\r' && all_.substr(first + 1, 1) != "\n") end_of_line_ = '\r';
    next_line();
    do {
      next_line();
    } while (read_line());
    if (!has_format_)
      fail("no line \"format\" before it, expected \"format ascii 1.0\" or a binary one");
    header_.begin = at_;
    return std::move(header_);
  }

 private:
  void next_line() {
    const std::size_t end = all_.find(end_of_line_, at_);
    if (end == string_view::npos) bytes_.fail("PLY header is cut short: no end_header");
    words_ = all_.substr(at_, end - at_);
    if (!words_.empty() && words_.back() == '\r') words_.remove_suffix(1);
    at_ = end + 1;
    ++header_.lines;
  }

  string_view word() {
    words_.remove_prefix(std::min(words_.find_first_not_of(" \t"), words_.size()));
    const string_view result =
        words_.substr(0, std::min(words_.find_first_of(" \t"), words_.size()));
    words_.remove_prefix(result.size());
    return result;
  }

  /// False at the last line.
  bool read_line() {
    const string_view key = word();
    if (key == "end_header") return false;
    if (key == "format")
      read_format();
    else if (key == "element")
      read_element();
    else if (key == "property")
      read_property();
    else if (!key.empty() && key != "comment" && key != "obj_info")
      fail(
          fmt::format("\"{}\", expected format, comment, obj_info, element, property or end_header",
                      quotable(key)));
    return true;
  }

  void read_format() {
    const string_view name = word(), version = word();
    if (name == "ascii")
      header_.encoding = PlyEncoding::kAscii;
    else if (name == "binary_little_endian")
      header_.encoding = PlyEncoding::kLittleEndian;
    else if (name == "binary_big_endian")
      header_.encoding = PlyEncoding::kBigEndian;
    else
      fail(fmt::format("format \"{}\", expected ascii, binary_little_endian or binary_big_endian",
                       quotable(name)));
    if (version != "1.0") fail(fmt::format("version \"{}\", expected 1.0", quotable(version)));
    has_format_ = true;
  }

  void read_element() {
    PlyElement element;
    element.name = word();
    const string_view text = word();
    const char* last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, element.count);
    constexpr long kMostOfOne = std::numeric_limits<int>::max() / 3;
    if (error != std::errc{} || end != last || element.count < 0 || element.count > kMostOfOne)
      fail(fmt::format("element without a count: \"{}\", expected 0 to {}", quotable(text),
                       kMostOfOne));
    for (const PlyElement& other : header_.elements)
      if (other.name == element.name)
        fail(fmt::format("a second element \"{}\", expected one", quotable(element.name)));
    header_.elements.push_back(std::move(element));
  }

  PlyType type() {
    const string_view name = word();
    const std::optional<PlyType> result = type_of(name);
    if (!result)
      fail(
          fmt::format("type \"{}\", expected char, uchar, short, ushort, int, uint, float, double "
                      "or the like of int8",
                      quotable(name)));
    return *result;
  }

  void read_property() {
    if (header_.elements.empty()) fail("property before any element");
    PlyProperty property;
    const string_view rest = words_;
    if (word() == "list") {
      property.count = type();
      if (!is_integer(*property.count)) fail("the number of items of a list must be an integer");
    } else {
      words_ = rest;
    }
    property.type = type();
    property.name = word();
    if (property.name.empty()) fail("property without a name");
    if (header_.elements.back().find(property.name))
      fail(fmt::format("a second property \"{}\", expected one", quotable(property.name)));
    header_.elements.back().properties.push_back(std::move(property));
  }

  [[noreturn]] void fail(const std::string& what) const {
    bytes_.fail(fmt::format("line {}: PLY header: {}", header_.lines, what));
  }

  const MeshBytes& bytes_;
  string_view all_, words_;
  char end_of_line_ = '\n';
  std::size_t at_ = 0;
  bool has_format_ = false;
  PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat:
      return 4;
    case PlyType::kDouble:
      break;
  }
  return 8;
}

bool is_integer(PlyType type) { return type != PlyType::kFloat && type != PlyType::kDouble; }

std::optional<std::size_t> PlyElement::find(string_view property) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return i;
  return std::nullopt;
}

std::size_t PlyElement::least_bytes() const {
  std::size_t bytes = 0;
  for (const PlyProperty& p : properties) bytes += size_of(p.count.value_or(p.type));
  return bytes;
}

PlyHeader read_ply_header(const MeshBytes& bytes) { return HeaderReader(bytes).read(); }

}  // namespace condyle
