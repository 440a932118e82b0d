#pragma once

/// Bytes as a list of choices, front to back: what a grammar asks when it makes something up. Behind the
/// last byte every choice is the first.

#include <cstddef>
#include <cstdint>
#include <span>

#include "fuzz/doors.h"

namespace condyle::fuzz {

class Choices {
 public:
  explicit Choices(Bytes bytes) : bytes_(bytes) {}

  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
  }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  /// 0 to n - 1, n at most 256.
  std::size_t below(std::size_t n) { return byte() % n; }
  /// Once in `n` times, with bytes that are anything.
  bool once_in(std::size_t n) { return below(n) == n - 1; }
  template <typename T, std::size_t n>
  const T& of(const T (&list)[n]) {
    return list[below(n)];
  }
  /// All 64 bits of it are chosen.
  std::uint64_t word() {
    std::uint64_t all = 0;
    for (int i = 0; i < 8; ++i) all = all << 8 | byte();
    return all;
  }
  [[nodiscard]] Bytes rest() const { return bytes_; }

 private:
  Bytes bytes_;
};

}  // namespace condyle::fuzz
