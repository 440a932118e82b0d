#pragma once

/// A scene on one page, before anything is solved: the knee at its start pose from four sides and
/// both bones alone, with the joint's frames, the ligaments and their insertions by name, and what a
/// person should look at.

#include <string>
#include <vector>

#include "condyle/pictures/image.h"
#include "condyle/results/run_file.h"

namespace condyle {

/// `run` holds the scene, its patches and meshes, and its start pose as the one pose. `remarks`: one
/// line each, below the pictures. Throws PictureError when the machine cannot draw.
[[nodiscard]] Image draw_scene_page(const Run& run, const std::vector<std::string>& remarks);

}  // namespace condyle
