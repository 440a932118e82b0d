#pragma once

/// What moves what: the derivatives of a run at up to four poses, as what a typical change of each
/// number does (results/sensitivity_effects.h), so that colours compare.

#include <optional>
#include <vector>

#include "condyle/pictures/heat_map.h"
#include "condyle/pictures/named_plot.h"
#include "condyle/results/run_file.h"

namespace condyle {

/// At most 40 numbers of the knee and 12 ligaments, those with the greatest effects. Nothing where
/// the run has no derivatives.
[[nodiscard]] std::optional<HeatMap> sensitivity_map(const Run& run);

/// It as a plot, "sensitivities"; none where there is no map. `beside`: panels beside each other.
[[nodiscard]] std::vector<NamedPlot> sensitivity_plots(const Run& run, std::size_t beside = 2);

}  // namespace condyle
