#pragma once

/// Numbers from 0 on in sets that are joined one after the other: which hang together.

#include <algorithm>
#include <numeric>
#include <vector>

namespace condyle {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n = 0) : parent_(n) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  /// One more, alone.
  void add() { parent_.push_back(static_cast<int>(parent_.size())); }
  /// The lowest number of the set that holds i.
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// False where they were joined already.
  bool join(int a, int b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
    return a != b;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace condyle
