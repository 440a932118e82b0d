#pragma once

/// Charts of a study: what its samples came to, and what of that which number explains. Blue are the
/// samples, dashed grey the knee as its scene has it; knees of a population have a colour each.

#include <vector>

#include "condyle/pictures/chart_page.h"
#include "condyle/pictures/heat_map.h"
#include "condyle/pictures/named_plot.h"
#include "condyle/results/study_file.h"

namespace condyle {

/// Every kept quantity over the sweep: 5 to 95 %, 25 to 75 %, median, nominal. Joint (study_joint),
/// contacts (study_contacts), ligaments that carry (study_ligaments).
[[nodiscard]] std::vector<NamedPage> study_band_pages(const StudyView& study);
/// The knees of a population beside each other (study_knees); none of one knee.
[[nodiscard]] std::vector<NamedPage> study_knee_pages(const StudyView& study);
/// Sobol's indices of the main quantities at up to four poses, the greatest first (study_indices);
/// none without them.
[[nodiscard]] std::vector<NamedPage> study_index_pages(const StudyView& study);
/// Poses without a result over the sweep, and by quarters of each parameter's samples (study_failures);
/// none where all have one.
[[nodiscard]] std::vector<NamedPage> study_failure_pages(const StudyView& study);
/// All of the above.
[[nodiscard]] std::vector<NamedPage> study_pages(const StudyView& study);

/// Parameters by quantities at up to four poses: rank correlations (study_correlations) and, where there
/// are any, total indices (study_totals). At most 40 parameters and 12 ligaments, the greatest.
[[nodiscard]] std::vector<NamedMap> study_maps(const StudyView& study);

/// Of maps: two beside each other, or a file for each.
enum class MapPanels { kTogether, kApart };

/// All of them.
[[nodiscard]] std::vector<NamedPlot> study_plots(const StudyView& study,
                                                 MapPanels panels = MapPanels::kTogether);

}  // namespace condyle
