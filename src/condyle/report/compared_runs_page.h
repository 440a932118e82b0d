#pragma once

/// Several runs as one HTML page: what differs in their scenes, and what that does (docs/report.md).

#include <string>
#include <vector>

#include "condyle/on_progress.h"
#include "condyle/report/compared_runs.h"

namespace condyle {

struct ComparedRunsPageOptions {
  bool pictures = true;  ///< where the program is built with them
  OnProgress on_part = {};
};

/// Throws PictureError where pictures cannot be drawn.
[[nodiscard]] std::string compared_runs_page(const RunComparison& comparison,
                                             const ComparedRunsPageOptions& options = {});

// Its sections, each as HTML.

[[nodiscard]] std::string compared_status_section(const RunComparison& comparison);
[[nodiscard]] std::string compared_scenes_section(const RunComparison& comparison);
[[nodiscard]] std::string compared_differences_section(const RunComparison& comparison);
[[nodiscard]] std::string compared_curves_section(const RunComparison& comparison);
/// Each run from the medial side, at the same places; nothing in a build without pictures.
[[nodiscard]] std::string compared_picture_section(const RunComparison& comparison);
[[nodiscard]] std::string compared_source_section(const RunComparison& comparison);

/// Names of the runs beside their lines.
[[nodiscard]] std::string run_legend(const RunComparison& comparison);

}  // namespace condyle
