#pragma once

/// A run for ParaView: posed bones, articular surfaces, ligaments and contacts as .vtp files, and
/// for each of the four kinds a .pvd that strings them together over the sweep. Lengths in mm,
/// ground frame.

#include <string>
#include <vector>

#include "condyle/exchange/export_file.h"
#include "condyle/exchange/run_shapes.h"
#include "condyle/exchange/shown_poses.h"

namespace condyle {

/// STEM_bones.pvd, STEM_surfaces.pvd, STEM_ligaments.pvd, STEM_contacts.pvd, of elastic layers
/// STEM_pressures.pvd, and what they name in
/// STEM_vtk/. The time of a step is the swept value where that grows all the way, else the time of
/// shown_poses.
[[nodiscard]] std::vector<ExportFile> vtk_of_poses(const Run& run,
                                                   const std::vector<ShownPose>& shown,
                                                   const std::vector<RunShape>& shapes,
                                                   const std::string& stem);

/// The ligaments of a pose as lines, with strain, force and length.
[[nodiscard]] std::string ligaments_vtp(const Run& run, const PoseResult& pose);

/// The points of contact of a pose, with the force on the moving body.
[[nodiscard]] std::string contacts_vtp(const Run& run, const PoseResult& pose);

}  // namespace condyle
