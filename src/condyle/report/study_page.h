#pragma once

/// A study as one HTML page that needs nothing else (docs/report.md): what varied, how many samples have
/// a result, what explains what, bands, and what it was computed from.

#include <string>

#include "condyle/on_progress.h"
#include "condyle/results/study_file.h"

namespace condyle {

struct StudyPageOptions {
  bool pictures = true;  ///< plots, where the program is built with them
  OnProgress on_part = {};
};

/// `file` names the study in the page. Throws PictureError where plots cannot be drawn.
[[nodiscard]] std::string study_page(const StudyView& study,
                                     const std::string& file,
                                     const StudyPageOptions& options = {});

// Its sections, each as HTML, or nothing where the study has nothing to say there.

/// How many samples there are, and whether poses without a result bias the bands.
[[nodiscard]] std::string study_status_section(const StudyView& study);
[[nodiscard]] std::string study_parameter_section(const StudyView& study);
[[nodiscard]] std::string study_effect_section(const StudyView& study);
[[nodiscard]] std::string study_band_section(const StudyView& study);
[[nodiscard]] std::string study_failure_section(const StudyView& study);
[[nodiscard]] std::string study_source_section(const StudyView& study, const std::string& file);
/// All plots; a sentence in a build without them.
[[nodiscard]] std::string study_plot_section(const StudyView& study);

}  // namespace condyle
