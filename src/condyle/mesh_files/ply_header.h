#pragma once

/// The header of a PLY file: which elements follow, and what each entry of them holds.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/mesh_files/mesh_bytes.h"

namespace condyle {

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };

enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };
[[nodiscard]] std::size_t size_of(PlyType type);  ///< [bytes]
[[nodiscard]] bool is_integer(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;  ///< of the value, or of the items of a list
  std::optional<PlyType> count;    ///< of a list: type of the number of items, an integer
};

struct PlyElement {
  std::string name;
  long count = 0;
  std::vector<PlyProperty> properties;

  /// Index of a property; nothing where there is none of this name.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view property) const;
  /// Bytes of one entry in a binary file; a list counts as empty.
  [[nodiscard]] std::size_t least_bytes() const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;
  long lines = 0;         ///< of the header
  std::size_t begin = 0;  ///< byte where the data begin: right behind the end of the last line,
                          ///< whatever the first byte of the data looks like
};

/// Throws InputError where the header breaks off or says what PLY does not know.
[[nodiscard]] PlyHeader read_ply_header(const MeshBytes& bytes);

}  // namespace condyle
