#pragma once

/// What a file of HDF5 declares may lie elsewhere: behind a link, in an external file, in the datasets that a
/// virtual one is made of, behind a filter that is a plug-in. And it may be more than the file can hold. Nothing of
/// that is followed, loaded or allocated.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace condyle {

/// What a link of a group is where it is no plain one; else empty.
[[nodiscard]] std::string foreign_link(std::int64_t group, const std::string& name);

/// What is wrong with the storage of a dataset; empty where its values lie in the file, and can: deflate makes at most
/// 1032 bytes of one. Reads nothing but its header.
[[nodiscard]] std::string foreign_storage(std::int64_t dataset);

/// Memory for texts of variable length, no more than the file is long: many texts may be one and the same place.
class TextMemory {
 public:
  explicit TextMemory(std::int64_t dataset);
  /// For HDF5: a pointer, or null where that is more than the file can hold.
  static void* allocate(std::size_t size, void* memory);
  static void keep(void* pointer, void* memory);

 private:
  std::size_t left_ = 0;
  std::vector<std::unique_ptr<char[]>> pieces_;
};

/// Hard links to an object: one, or it stands in the file at several places, perhaps within itself.
[[nodiscard]] unsigned links_to(std::int64_t object);

}  // namespace condyle
