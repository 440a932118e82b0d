#pragma once

/// Answers of a process that holds a file open (hdf5_process.h).

#include "condyle/results/hdf5_group.h"
#include "condyle/results/hdf5_process.h"

namespace condyle {

/// Of a file's root, which is read by this process.
[[nodiscard]] Hdf5Process::Answering answers_of(Hdf5Group root);

}  // namespace condyle
