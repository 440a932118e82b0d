#pragma once

/// Contact along a straight line: a cylinder on a plane, two parallel cylinders. The gap has no
/// isolated minimum there; what carries are the two ends of the line, where the known part of one
/// of the surfaces ends. Two points hold height and tilt, their forces give the resultant.
///
/// While the bodies are still tilted against each other the same two ends are what must not
/// penetrate, so the search gives them in place of the lowest sample.

#include <array>
#include <vector>

#include "condyle/contact/contact.h"
#include "condyle/contact/gap_minimum.h"

namespace condyle {

/// Ends lie this far within the known surface [mm], so that round-off does not put them beyond.
inline constexpr double kWithinEdge = 5e-10;

/// Do both surfaces consist of straight lines, so far as their samples tell? Others need not be
/// asked for the ends of a line.
[[nodiscard]] bool have_straight_lines(const SurfacePair& surfaces, double spacing);

/// The relative curvature nearly vanishes in one direction, in which neither surface bends.
[[nodiscard]] bool is_line(const ContactLinearization& contact, const Eigen::Matrix3d& R_BA);

/// The ends of the line through a place, lowest first; false where there is no line or where it has
/// no ends. `spacing` of the samples of the search [mm].
bool find_line_ends(const SurfacePair& surfaces,
                    const ContactPlaces& places,
                    const RigidTransform& X_BA,
                    double spacing,
                    std::array<GapMinimum, 2>& ends);

/// For the search: puts the ends that lie below `cutoff` into `minima`; true where they stand for
/// `minimum`, false where it counts itself.
bool add_line_ends(const SurfacePair& surfaces,
                   const RigidTransform& X_BA,
                   const GapMinimum& minimum,
                   double spacing,
                   double cutoff,
                   std::vector<GapMinimum>& minima);

}  // namespace condyle
