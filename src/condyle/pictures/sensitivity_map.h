#pragma once

/// What moves what: the derivatives of a run at up to four poses, as what a typical change of each
/// number does (results/sensitivity_effects.h), so that colours compare.

#include <filesystem>
#include <optional>
#include <vector>

#include "condyle/pictures/heat_map.h"
#include "condyle/results/run_file.h"

namespace condyle {

/// At most 40 numbers of the knee and 12 ligaments, those with the greatest effects. Nothing where
/// the run has no derivatives.
[[nodiscard]] std::optional<HeatMap> sensitivity_map(const Run& run);

/// Writes sensitivities.png, .svg or .pdf; returns the paths, none where there is no map. `beside`:
/// panels beside each other.
std::vector<std::filesystem::path> plot_sensitivities(const Run& run,
                                                      const std::filesystem::path& folder,
                                                      const std::vector<PlotFormat>& formats,
                                                      std::size_t beside = 2);

}  // namespace condyle
