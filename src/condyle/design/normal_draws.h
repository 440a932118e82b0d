#pragma once

/// Independent standard normal numbers, each a function of where it stands and of nothing else: of a
/// seed, what they are for, which sample, which component. Counter-based (Philox4x64 of [Salmon 2011])
/// with Box and Muller's transform, so that any sample can be drawn by any thread.

#include <Eigen/Core>

#include <cstdint>

namespace condyle {

enum class DrawsFor : std::uint64_t {
  kStart = 1,
  kPriorMean = 2,
  kNoise = 3,
  kRoughness = 4,
  kPopulation = 16
};

[[nodiscard]] Eigen::VectorXd normal_draws(std::uint64_t seed,
                                           DrawsFor what,
                                           std::uint64_t sample,
                                           Eigen::Index count);

}  // namespace condyle
