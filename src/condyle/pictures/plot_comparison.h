#pragma once

/// Charts of the reference model beside ours, and of a test of laxity. Ours is drawn through, the
/// reference dashed in the same colour.

#include <string>
#include <vector>

#include "condyle/pictures/run_charts.h"
#include "condyle/results/run_file.h"

namespace condyle {

/// Joint coordinates, contact forces, places of contact, ligament forces, the flexion moment, and
/// what each part of the reference model does alone. None where the run holds no comparison.
[[nodiscard]] std::vector<NamedChart> comparison_charts(const Run& run);

/// Displacement over load at each flexion; a panel for the knee as it is and one for the cut knee.
[[nodiscard]] Chart laxity_chart(const Run& run);

}  // namespace condyle
