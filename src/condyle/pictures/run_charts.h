#pragma once

/// The curves of a run over what it sweeps. Poses that did not converge leave gaps, in which those
/// that have a place (results/run_view.h) are hollow points; a chart without a curve has no panels.

#include <string>
#include <vector>

#include "condyle/pictures/gnuplot.h"
#include "condyle/results/run_file.h"

namespace condyle {

struct NamedChart {
  std::string name;  ///< of the file, without its ending
  Chart chart;
};

/// A curve with a value for each pose of a sweep, divided between following poses that do not
/// belong to one piece of a contact's path.
[[nodiscard]] Curve broken_at_jumps(Curve curve, const SweepResult& sweep, std::size_t contact);

[[nodiscard]] Chart joint_coordinate_chart(const Run& run);
[[nodiscard]] Chart contact_force_chart(const Run& run);
/// Where the resultant of each contact acts, along the tibia's anatomical axes from its origin; not
/// joined where the contact jumped (results/contact_path.h).
[[nodiscard]] Chart contact_place_chart(const Run& run);
/// Greatest pressure and area of each contact of elastic layers.
[[nodiscard]] Chart contact_pressure_chart(const Run& run);
/// Strands of one ligament are summed.
[[nodiscard]] Chart ligament_force_chart(const Run& run);
/// Of the strands of one ligament the greatest strain; ligaments without a slack length have none.
[[nodiscard]] Chart ligament_strain_chart(const Run& run);
/// By how much ligaments that wrap are turned on each surface; nothing where none wraps.
[[nodiscard]] Chart wrap_angle_chart(const Run& run);
/// The multiplier of the flexion condition: the moment with which the knee itself would flex.
[[nodiscard]] Chart flexion_moment_chart(const Run& run);
/// The lowest eigenvalue of the reduced stiffness: below zero the position is unstable.
[[nodiscard]] Chart stability_chart(const Run& run);
/// Of a motion: kinetic, potential and ligament energy, dissipation, work of the loads, and how far
/// their balance departs from its start.
[[nodiscard]] Chart energy_chart(const Run& run);

/// All of the above, by the names of their files.
[[nodiscard]] std::vector<NamedChart> run_charts(const Run& run);

}  // namespace condyle
