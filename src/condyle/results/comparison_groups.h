#pragma once

/// What a result file holds of the reference model: /reference and /compare of `condyle compare`,
/// /laxity of `condyle laxity` (docs/results.md).

#include "condyle/compare/laxity.h"
#include "condyle/results/hdf5_file.h"

namespace condyle {

void write_comparison(const Hdf5Group& root, const Scene& scene, const Comparison& comparison);
[[nodiscard]] Comparison read_comparison(const Hdf5Group& root, const Scene& scene);

void write_laxity(const Hdf5Group& laxity, const Scene& scene, const LaxityResult& result);
/// Poses with what the file holds of them: value, status, joint coordinates, contact and ligament
/// forces.
[[nodiscard]] LaxityResult read_laxity(const Hdf5Group& laxity, const Scene& scene);

}  // namespace condyle
