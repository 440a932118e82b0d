#include "condyle/design/sobol_points.h"

#include <bit>
#include <boost/random/sobol.hpp>

#include "condyle/design/random_bits.h"
#include "condyle/design/uniform_draws.h"

namespace condyle {

namespace {

constexpr unsigned kIndexBits = 63;

}  // namespace

const std::size_t SobolPoints::kMostDimensions = boost::random::default_sobol_table::max_dimension;

SobolPoints::SobolPoints(std::size_t dimensions, std::uint64_t seed) : dimensions_(dimensions) {
  // Point 2^(bit+1) - 1 is the one whose Gray's code has that bit alone; the engine's seed 0 is point 1.
  boost::random::sobol engine(dimensions);
  for (unsigned bit = 0; bit < kIndexBits; ++bit) {
    engine.seed((std::uint64_t{2} << bit) - 2);
    for (std::size_t j = 0; j < dimensions; ++j) directions_.push_back(engine());
  }
  const auto what = static_cast<std::uint64_t>(UniformFor::kShift);
  for (std::size_t j = 0; j < dimensions; ++j)
    shift_.push_back(random_bits({0, j, 1, 0}, {seed, what})[0]);
}

double SobolPoints::coordinate(std::uint64_t k, std::size_t dimension) const {
  std::uint64_t bits = shift_[dimension];
  for (std::uint64_t gray = k ^ (k >> 1); gray != 0; gray &= gray - 1)
    bits ^= directions_[static_cast<std::size_t>(std::countr_zero(gray)) * dimensions_ + dimension];
  return open_unit(bits);
}

}  // namespace condyle
