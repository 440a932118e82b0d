#pragma once

/// Elastic layers as the law of a pair (contact_law.h): U = (U_A + U_B)/2, material points of
/// either surface pressed into the other (layer_side.h). The mean takes away the preference of a
/// side, which is of the order of depth over radius. A surface without bounds, or too large for a fine lattice, has no points:
/// those of the other carry alone.
///
/// The lattice is as fine as the force asks for: a pose is solved on one lattice, which is held
/// meanwhile, and solved on with a finer one until the force on a lattice shifted by half a cell
/// agrees with it. Each pose begins with the coarsest that should do by the number of points that are
/// pressed where it starts, so that nothing depends on poses before.

#include <array>
#include <memory>
#include <mutex>
#include <optional>

#include "condyle/contact/contact_law.h"
#include "condyle/contact/layer_lattice.h"
#include "condyle/contact/layer_law.h"
#include "condyle/contact/layer_options.h"

namespace condyle {

/// For a pair whose surfaces have a layer each, or one of them; throws std::invalid_argument where
/// LayerLaw does, or where neither surface has points. Lattices are shared by all that it makes.
/// `origin` of the model's frame of B, in that of files: for words about places [mm].
[[nodiscard]] ContactLaw layer_contact(const LayerOptions& options = {},
                                       const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

}  // namespace condyle
