#pragma once

/// What elastic layers say of each pose, beside the other numbers of a contact, and the pressure on
/// both surfaces: datasets of /sweep/contacts/NAME.

#include "condyle/equilibrium/pose_result.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// Nothing of a contact that is not one of layers.
void write_layers(const Hdf5Group& contact,
                  const Scene& scene,
                  const std::vector<PoseResult>& poses,
                  std::size_t index);

/// Of a file that has it; contacts, their resultants and the poses are there already.
void read_layers(const Hdf5Group& contact,
                 const Scene& scene,
                 std::vector<PoseResult>& poses,
                 std::size_t index);

}  // namespace condyle
