#pragma once

/// A population of phantom knees: measures drawn with the spread that the literature has. docs/phantom.md
/// tells what is published, what is derived of it and what is assumed.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "phantom/phantom_parameters.h"

namespace condyle::phantom {

/// How a measure varies between knees.
struct MeasureSpread {
  const char* name;  ///< "femur.size.width"
  double mean, sd;   ///< of men, or of all; in units of the measure
  double women, sd_women;
  const char* unit;    ///< "mm", "deg", "1/mm"; "1": a factor
  const char* source;  ///< and what it is: read, derived or assumed
};

/// In the order of the draws.
[[nodiscard]] std::span<const MeasureSpread> measure_spreads();

/// Correlation of any two of the four sizes within a sex.
inline constexpr double kSizeCorrelation = 0.79;
/// No measure lies further from its mean [sd].
inline constexpr double kMostDeviations = 2;

/// A knee and what it was made of.
struct PopulationKnee {
  bool woman = false;
  std::vector<double> measures;  ///< as measure_spreads
  PhantomParameters parameters;
};

/// Knee `number` of the population `seed`: a function of both and of nothing else. Half of the knees are
/// women's. Both compartments are closed at the start pose.
[[nodiscard]] PopulationKnee population_knee(std::uint64_t seed, std::uint64_t number);

/// `knee` with these measures, its compartments not closed yet.
[[nodiscard]] PhantomParameters with_measures(const std::vector<double>& measures);

/// Least value of the femur's shape over a plateau in the common frame: the gap at the start pose [mm].
/// side: -1 medial, +1 lateral.
[[nodiscard]] double start_gap(const PhantomParameters& knee, int side);

/// Moves the tibia along y, and its lateral plateau against the medial one, until the gaps of both
/// compartments at the start pose are those of the shipped phantom times the depth of the femur.
[[nodiscard]] PhantomParameters with_closed_compartments(PhantomParameters knee);

}  // namespace condyle::phantom
