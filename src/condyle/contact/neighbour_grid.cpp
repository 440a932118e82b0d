#include "condyle/contact/neighbour_grid.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace condyle {
namespace {

constexpr int kMost = 8;
constexpr double kSide = 0.6;        // of a cube, of the radius: neighbours mostly lie in the next
constexpr double kCubesAPoint = 16;  // more are not worth their memory
constexpr double kWider = 1.26;      // cubes of half the number

/// Points sorted by the cubes in which they lie; those of cubes that follow each other along z lie
/// next to each other.
class Grid {
 public:
  Grid(const std::vector<Eigen::Vector3d>& points, double side) : side_(side) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : points) box.extend(p);
    low_ = box.min();
    const double most = kCubesAPoint * static_cast<double>(points.size()) + 64;
    while (((box.sizes() / side_).array() + 1).prod() > most) side_ *= kWider;
    inverse_ = 1 / side_;
    count_ = (box.sizes() * inverse_).cast<int>().array() + 1;
    begin_.assign(static_cast<std::size_t>(count_.prod()) + 1, 0);
    std::vector<int> cube(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Eigen::Array3i c = cube_of(points[i]);
      ++begin_[1 + static_cast<std::size_t>(cube[i] = index(c.x(), c.y(), c.z()))];
    }
    for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
    sorted_.resize(points.size());
    std::vector<int> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < points.size(); ++i)
      sorted_[static_cast<std::size_t>(next[static_cast<std::size_t>(cube[i])]++)] = {
          points[i], static_cast<int>(i)};
  }

  [[nodiscard]] double side() const { return side_; }

  /// Calls visit(index, square of the distance) for the points of all cubes that are no more than
  /// `rings` away from that of p: all points within rings × side and some others.
  template <typename Visit>
  void for_each_near(const Eigen::Vector3d& p, int rings, const Visit& visit) const {
    const Eigen::Array3i c = cube_of(p), from = (c - rings).max(0);
    const Eigen::Array3i to = (c + rings).min(count_ - 1);
    for (int x = from.x(); x <= to.x(); ++x)
      for (int y = from.y(); y <= to.y(); ++y) {
        const int first = begin_[static_cast<std::size_t>(index(x, y, from.z()))];
        const int last = begin_[static_cast<std::size_t>(index(x, y, to.z())) + 1];
        for (int k = first; k < last; ++k) {
          const Entry& entry = sorted_[static_cast<std::size_t>(k)];
          visit(entry.point, (entry.c - p).squaredNorm());
        }
      }
  }

 private:
  struct Entry {
    Eigen::Vector3d c;
    int point;
  };
  [[nodiscard]] Eigen::Array3i cube_of(const Eigen::Vector3d& p) const {
    return ((p - low_) * inverse_).cast<int>().array().min(count_ - 1);
  }
  [[nodiscard]] int index(int x, int y, int z) const {
    return (x * count_.y() + y) * count_.z() + z;
  }

  double side_, inverse_;
  Eigen::Vector3d low_;
  Eigen::Array3i count_;
  std::vector<int> begin_;  ///< of each cube in sorted_
  std::vector<Entry> sorted_;
};

/// The nearest so far, nearest first.
struct Nearest {
  std::array<double, kMost> square;
  std::array<int, kMost> index;

  explicit Nearest(double within) {
    square.fill(within);
    index.fill(-1);
  }
  void add(int point, double d) {
    if (d >= square.back()) return;
    std::size_t k = kMost - 1;
    for (; k > 0 && square[k - 1] > d; --k) {
      square[k] = square[k - 1];
      index[k] = index[k - 1];
    }
    square[k] = d;
    index[k] = point;
  }
};

}  // namespace

std::vector<std::array<int, 8>> nearest_neighbours(const std::vector<Eigen::Vector3d>& points,
                                                   double radius) {
  std::vector<std::array<int, 8>> neighbours(points.size());
  if (points.empty()) return neighbours;
  const Grid grid(points, kSide * radius);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int rings = 1;; ++rings) {
      Nearest nearest(radius * radius);
      grid.for_each_near(points[i], rings, [&](int point, double square) {
        if (point != static_cast<int>(i)) nearest.add(point, square);
      });
      neighbours[i] = nearest.index;
      const double known = rings * grid.side();  // all points within are seen
      if (known >= radius || nearest.square.back() < known * known) break;
    }
  }
  return neighbours;
}

}  // namespace condyle
