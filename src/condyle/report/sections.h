#pragma once

/// The sections of a report, each as HTML, or nothing where the run has nothing to say there.

#include <string>
#include <vector>

#include "condyle/results/run_view.h"

namespace condyle {

/// A swept value in its unit, without the unit: "35".
[[nodiscard]] std::string at_value(const SweptQuantity& swept, double value);

[[nodiscard]] std::string status_section(const Run& run);
[[nodiscard]] std::string pose_section(const Run& run);
[[nodiscard]] std::string contact_section(const Run& run);
[[nodiscard]] std::string layer_section(const Run& run);  ///< of elastic layers
[[nodiscard]] std::string ligament_section(const Run& run);
[[nodiscard]] std::string event_section(const Run& run);
[[nodiscard]] std::string solver_section(const Run& run);
/// By which way poses were found: a part of the solver's section.
[[nodiscard]] std::string trace_details(const std::vector<PoseResult>& poses,
                                        const SweptQuantity& swept);
[[nodiscard]] std::string calibration_section(const Run& run);
[[nodiscard]] std::string comparison_section(const Run& run);
[[nodiscard]] std::string laxity_section(const Run& run);
[[nodiscard]] std::string motion_section(const Run& run);  ///< of a simulation
[[nodiscard]] std::string fit_section(const Run& run);
[[nodiscard]] std::string source_section(const Run& run, const std::string& file);

/// Pictures at some poses, and the plots; a sentence in a build without them.
[[nodiscard]] std::string picture_section(const Run& run);
[[nodiscard]] std::string plot_section(const Run& run);

/// Derivatives by numbers of the knee: the greatest effects in words, with the map of plot above.
[[nodiscard]] std::string sensitivity_section(const Run& run, bool with_map);
/// The map alone; nothing in a build without plots.
[[nodiscard]] std::string sensitivity_figure(const Run& run);

/// The 3-D view with its data and the program that shows it; a sentence in a build without it.
[[nodiscard]] std::string viewer_section(const Run& run, const std::string& file);

}  // namespace condyle
