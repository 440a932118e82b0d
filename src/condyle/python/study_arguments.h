#pragma once

/// Arguments that several studies of a scene have in common.

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "condyle/compare/compare.h"
#include "condyle/python/knee.h"

namespace condyle::python {

/// A whole number within bounds; TypeError for what is none, InputError beyond them.
[[nodiscard]] long long whole_number(const pybind11::handle& value,
                                     const std::string& argument,
                                     long long least,
                                     long long most);

/// None: 0, as many as there are cores.
[[nodiscard]] int threads_of(const pybind11::handle& threads);

/// Throws InputError where a model has loads that are functions, which `study` cannot follow.
void check_no_own_loads(const KneeModel& knee, const std::string& study);

/// The model that `scene` means (bindings.h). Throws InputError where it has loads that are functions: `study` makes
/// models of its own, which do not know them.
[[nodiscard]] std::shared_ptr<const KneeModel> model_without_own_loads(
    const pybind11::object& scene, const std::string& study);

/// How Wismans' model is made of a scene.
[[nodiscard]] CompareOptions reference_options(const pybind11::handle& degree,
                                               const pybind11::handle& strain);

}  // namespace condyle::python
