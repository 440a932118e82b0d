#pragma once

/// A run as one HTML page that needs nothing else: no network, no other file (docs/report.md).

#include <string>

#include "condyle/on_progress.h"
#include "condyle/results/run_file.h"

namespace condyle {

struct ReportOptions {
  bool pictures = true;  ///< pictures and plots, where the program is built with them
  bool viewer = true;    ///< the 3-D view, likewise
  OnProgress on_part = {};
};

/// `file` names the run in the page. Throws InputError, PictureError where pictures cannot be
/// drawn.
[[nodiscard]] std::string report_page(const Run& run,
                                      const std::string& file,
                                      const ReportOptions& options = {});

}  // namespace condyle
