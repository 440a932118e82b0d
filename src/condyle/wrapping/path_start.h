#pragma once

/// A surface comes into a path: it is moved aside until the path just touches it, and moved back in steps
/// with Newton at each.

#include "condyle/wrapping/path_chain.h"
#include "condyle/wrapping/touching_line.h"

namespace condyle {

/// Where link `link` goes into the chain: the chain holds the others, solved, and X, Y. `side`, if any, is
/// the direction (ground frame) towards which the path shall pass; else it leaves where that is nearest.
/// True with the chain solved; else the chain is as it was.
bool insert_link(PathChain& chain, const ChainLink& link, const Eigen::Vector3d* side);

}  // namespace condyle
