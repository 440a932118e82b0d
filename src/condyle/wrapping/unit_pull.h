#pragma once

#include "condyle/elements/end_rates.h"
#include "condyle/elements/wrench.h"
#include "condyle/wrapping/path_chain.h"

namespace condyle {

/// The wrench of a tension of 1 N on A, about a, of a chain that solve() has left, with its exact
/// derivatives: the geodesics follow each motion of A so that the path errors stay 0, and only the
/// pieces that cross from one body to the other pull.
[[nodiscard]] Wrench unit_pull(const PathChain& chain, const Eigen::Vector3d& a);

/// How its length and that wrench change as the point where it begins or ends moves on its body, which
/// of an anchored end is the anchor, moving along its surface. Of a chain with links.
[[nodiscard]] LineRates chain_end_rates(const PathChain& chain, const Eigen::Vector3d& a);

}  // namespace condyle
