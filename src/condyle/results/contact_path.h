#pragma once

/// The path that a contact leaves over the poses of a run: what may be joined by a line, and what
/// must not because the contact jumped or a pose is missing.

#include <cstddef>
#include <vector>

#include "condyle/equilibrium/pose_result.h"

namespace condyle {

/// Converged poses (indices into sweep.poses) whose places of the contact follow each other; the
/// place is that of the point with the greatest force, on both bodies. A piece ends
///   where the contact is open or a pose did not converge;
///   where /events holds a jump of the contact, an opening and a closing of it, or a limit point of
///   the joint between two poses;
///   where another point of the contact comes to carry most;
///   where a step is more than 3 mm and more than four times as long per unit of the swept value as
///   the steps around it, or more than 25 mm.
[[nodiscard]] std::vector<std::vector<std::size_t>> contact_path(const SweepResult& sweep,
                                                                 std::size_t contact);

/// The same of where the contact's resultant acts, its points weighted by force: it ends where the
/// contact is lost or jumps, not where another of several points comes to carry most, for there the
/// resultant moves on smoothly.
[[nodiscard]] std::vector<std::vector<std::size_t>> resultant_path(const SweepResult& sweep,
                                                                   std::size_t contact);

/// Do two poses lie in one piece, with every pose between them?
[[nodiscard]] bool joined(const std::vector<std::vector<std::size_t>>& path,
                          std::size_t a,
                          std::size_t b);

}  // namespace condyle
