#include "condyle/mesh_files/vertex_index.h"

#include <bit>
#include <cstdint>

namespace condyle {

VertexIndex::VertexIndex(std::vector<Eigen::Vector3d>& vertices, std::size_t expected)
    : vertices_(vertices), slots_(std::bit_ceil(2 * expected + 16), -1) {
  vertices_.reserve(expected);
}

std::size_t VertexIndex::slot_of(const Eigen::Vector3d& p) const {
  std::uint64_t key = 0;
  for (const double x : {p.x(), p.y(), p.z()}) {
    key ^= std::bit_cast<std::uint64_t>(x + 0.0);  // -0 + 0 is 0
    key *= 0x9E3779B97F4A7C15u;                    // 2^64 / golden ratio
    key ^= key >> 29;
  }
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = key & mask;
  while (slots_[slot] >= 0 && vertices_[slots_[slot]] != p) slot = (slot + 1) & mask;
  return slot;
}

int VertexIndex::number_of(const Eigen::Vector3d& p) {
  const std::size_t slot = slot_of(p);
  if (slots_[slot] >= 0) return slots_[slot];
  const int number = static_cast<int>(vertices_.size());
  slots_[slot] = number;
  vertices_.push_back(p);
  if (2 * vertices_.size() > slots_.size()) grow();
  return number;
}

void VertexIndex::grow() {
  slots_.assign(2 * slots_.size(), -1);
  for (std::size_t i = 0; i < vertices_.size(); ++i)
    slots_[slot_of(vertices_[i])] = static_cast<int>(i);
}

}  // namespace condyle
