#pragma once

/// /wraps/NAME of a run: the wraps that were fitted to bones, which the scene's text does not tell.

#include "condyle/results/hdf5_file.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// Creates /wraps where there is such a wrap.
void write_wraps(const Hdf5Group& root, const Scene& scene);

/// Gives them shape, place and figures again, and their ligaments the slack lengths that follow.
void read_fitted_wraps(const Hdf5Group& root, Scene& scene);

}  // namespace condyle
