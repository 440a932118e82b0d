#pragma once

/// Patches of the Lenhart knee on which another program computed elastic layers.

#include <filesystem>
#include <string>

#include "condyle/results/hdf5_file.h"
#include "condyle/surface/patch.h"

namespace condyle::test {

inline const std::filesystem::path kLayer =
    std::filesystem::path(CONDYLE_SOURCE_DIR) / "../shared/published/layer";

inline Patch layer_patch(const std::string& name) {
  const Hdf5Reader reader(kLayer / "lenhart_patches.h5");
  const Hdf5Group group = reader.root().open("patches").open(name);
  PatchData data;
  const Hdf5Array net = group.read("control_points"), mask = group.read("mask");
  data.nu = static_cast<int>(net.shape[0]);
  data.nv = static_cast<int>(net.shape[1]);
  for (std::size_t i = 0; i < net.values.size(); i += 3)
    data.control_points.emplace_back(net.values[i], net.values[i + 1], net.values[i + 2]);
  const std::vector<int> degree = group.read_integers("degree", {2});
  data.degree = {degree[0], degree[1]};
  data.knots_u = group.read("knots_u").values;
  data.knots_v = group.read("knots_v").values;
  data.mask_nu = static_cast<int>(mask.shape[0]) - 1;
  data.mask_nv = static_cast<int>(mask.shape[1]) - 1;
  data.mask = mask.values;
  data.orientation = static_cast<int>(group.read("orientation").values[0]);
  return Patch(data);
}

}  // namespace condyle::test
