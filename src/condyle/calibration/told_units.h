#pragma once

/// Units in which the numbers of a calibration are told.

#include "condyle/calibration/free_parameter.h"
#include "condyle/scene/sweep_range.h"

namespace condyle {

/// Of θ in files: rad becomes deg, mm and 1 stay.
[[nodiscard]] Unit unit_of_theta(const FreeParameter& parameter);
/// The same for people: strains in %.
[[nodiscard]] Unit unit_for_people(const FreeParameter& parameter);

/// A [[calibrate.load]]; null for none, and for one that the scene does not have.
[[nodiscard]] const CalibrationLoad* find_load(const Scene& scene, int load);
/// Of its level: "N", "N m", "mm" or "deg"; without a name where there is none.
[[nodiscard]] Unit unit_of_level(const Scene& scene, int load);

}  // namespace condyle
