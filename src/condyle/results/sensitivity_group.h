#pragma once

/// Derivatives of the poses of a sweep: /sweep/sensitivities of a result file.

#include <memory>

#include "condyle/equilibrium/sweep_sensitivities.h"
#include "condyle/results/hdf5_file.h"

namespace condyle {

/// As results tell it: output `i` by parameter `j` at a pose, in deg, mm, N or N mm by the unit of
/// the parameter.
[[nodiscard]] double shown_derivative(const SweepSensitivities& sensitivities,
                                      std::size_t pose,
                                      std::size_t i,
                                      std::size_t j);

void write_sensitivities(const Hdf5Group& group, const SweepSensitivities& sensitivities);

/// What they are of and by follows from the scene; throws InputError where the file holds others.
[[nodiscard]] std::shared_ptr<const SweepSensitivities> read_sensitivities(const Hdf5Group& group,
                                                                           const Scene& scene,
                                                                           std::size_t poses);

}  // namespace condyle
