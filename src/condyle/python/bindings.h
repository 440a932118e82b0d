#pragma once

/// The parts of the module `condyle._condyle`, each bound in a file of its own and called by module.cpp in this order:
/// a class is bound before the functions that have it in their signatures.
///
/// A study that makes a run of another kind (laxity, comparison, simulation, calibration) is one more file,
/// bind_NAME.cpp: it takes a Model's KneeModel (knee.h), releases the interpreter's lock, calls the library, puts what
/// that gives into Run::study of a copy of KneeModel::empty_run() without patches, and returns
/// std::make_shared<RunData>(model, run): columns, save and report follow from results/run_columns.h. One line here, one
/// in module.cpp, the name in condyle/__init__.py and its signature in condyle/_condyle.pyi.

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>

#include "condyle/python/knee.h"
#include "condyle/python/run_data.h"

namespace condyle::python {

namespace py = pybind11;

void bind_errors(py::module_& m);
void bind_build_info(py::module_& m);
void bind_scene(py::module_& m);
void bind_columns(py::module_& m);
void bind_pose(py::module_& m);
void bind_model(py::module_& m);
void bind_solver(py::module_& m);
void bind_run(py::module_& m);
void bind_sweep(py::module_& m);
void bind_laxity(py::module_& m);
void bind_compare(py::module_& m);
void bind_simulate(py::module_& m);
void bind_calibrate(py::module_& m);
void bind_study(py::module_& m);
void bind_new_scene(py::module_& m);
void bind_timings(py::module_& m);

/// Of a class whose objects functions return: Python may not make one, which would have nothing inside.
void only_returned(const py::handle& type);

/// A progress callback of Python, or nothing for None; to be called without the interpreter's lock.
[[nodiscard]] OnProgress progress_of(const py::object& progress);

/// The model that an argument means: a Model, or a scene (condyle.Scene), of which one is made.
[[nodiscard]] std::shared_ptr<const KneeModel> model_of(const py::object& scene_or_model);

/// A description (condyle.Scene) as the reader understands it, with its functions. Throws InputError.
[[nodiscard]] std::shared_ptr<const KneeScene> scene_of(const py::object& scene);

/// A group of a tree as Python sees it; `owner` keeps it alive. At a row of its columns where `row` >= 0, those that
/// have one for each of so many poses.
[[nodiscard]] py::object group_of(std::shared_ptr<const void> owner,
                                  const ColumnTree& tree,
                                  std::string place,
                                  long row = -1,
                                  std::size_t poses = 1);
/// A dataset, or a group, at "ligaments/aACL/force". Throws KeyError with the nearest name.
[[nodiscard]] py::object at_place(const std::shared_ptr<const void>& owner,
                                  const ColumnTree& tree,
                                  const std::string& place,
                                  long row = -1,
                                  std::size_t poses = 1);

}  // namespace condyle::python
