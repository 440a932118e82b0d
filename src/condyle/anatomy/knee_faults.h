#pragma once

/// What two meshes are where they are no knee, in one line each.

#include <optional>

#include "condyle/anatomy/femoral_frame.h"
#include "condyle/anatomy/knee_meshes.h"
#include "condyle/anatomy/tibial_frame.h"

namespace condyle {

/// Empty meshes, two of one bone, sizes that no one unit explains, cartilage that lies elsewhere.
void check_meshes(const KneeMeshes& meshes);

/// Factor to mm in which both ends are as wide as knees are: the one that is given, or of mm, cm, inch and m.
[[nodiscard]] double tell_unit(const KneeEnds& ends, const std::optional<double>& given);

/// As find_condyles and find_tibial_frame; where they fail the message says what the meshes look like instead. In mm.
[[nodiscard]] Condyles find_condyles_or_say_why(CleanMesh& femur,
                                                const CleanMesh& tibia,
                                                const KneeEnds& ends);
[[nodiscard]] TibialShape find_tibia_or_say_why(CleanMesh& tibia,
                                                const KneeEnds& ends,
                                                const Condyles& condyles);

/// Shafts go where the frames say.
void check_shafts(const CleanMesh& femur_mesh,
                  const FemoralShape& femur,
                  const CleanMesh& tibia_mesh,
                  const TibialShape& tibia);

/// Cartilage reaches to both sides of the middle of its bone, not one compartment alone. `frame` in mm, in the axes of the
/// meshes, which `to_mm` makes mm; `width` of the bone [mm].
void check_both_sides(const TriangleMesh& cartilage,
                      double to_mm,
                      const BoneFrame& frame,
                      double width,
                      const char* name);

/// Widths of one person, ends that face each other. `unit`: in words, that of the files, and whether it was said.
void check_they_fit(const FemoralShape& femur,
                    const TibialShape& tibia,
                    const KneeEnds& ends,
                    const std::string& unit);

}  // namespace condyle
