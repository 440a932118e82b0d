#pragma once

/// The curves of a run over what it sweeps: joint coordinates, contact forces, ligament forces.
/// Poses that did not converge leave gaps.

#include <filesystem>
#include <vector>

#include "pictures/gnuplot.h"
#include "results/run_file.h"

namespace condyle {

[[nodiscard]] Chart joint_coordinate_chart(const Run& run);
[[nodiscard]] Chart contact_force_chart(const Run& run);
/// Strands of one ligament are summed.
[[nodiscard]] Chart ligament_force_chart(const Run& run);

/// Writes joint_coordinates, contact_forces and ligament_forces into `folder`, in every format, and
/// returns the paths. Charts without a curve are left out.
std::vector<std::filesystem::path> plot_run(const Run& run,
                                            const std::filesystem::path& folder,
                                            const std::vector<PlotFormat>& formats);

}  // namespace condyle
