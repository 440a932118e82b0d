#pragma once

/// The random numbers of one scene, one after the other: a function of a seed and of the scene's number.

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>

namespace condyle::random_knees {

class Draws {
 public:
  Draws(std::uint64_t seed, std::uint64_t scene) : seed_(seed), scene_(scene) {}

  double unit();                                  ///< of the open unit interval
  double between(double least, double most);      ///< uniform
  double of_any_size(double least, double most);  ///< > 0, its logarithm uniform
  bool chance(double probability);
  int below(int n);                     ///< 0 ... n - 1
  Eigen::Vector3d within(double half);  ///< of a cube about the origin
  Eigen::Vector3d direction();
  Eigen::Matrix3d rotation();  ///< any

 private:
  std::uint64_t seed_, scene_, block_ = 0;
  std::array<std::uint64_t, 4> bits_{};
  std::size_t used_ = 4;
};

}  // namespace condyle::random_knees
