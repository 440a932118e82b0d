#include "condyle/python/bindings.h"
#include "condyle/python/interrupts.h"

#include <pybind11/numpy.h>

PYBIND11_MODULE(_condyle, m) {
  using namespace condyle::python;
  m.doc() = "The compiled part of condyle; its names are those of the package condyle.";
  // NumPy's part of pybind11 is made where it is first used, and two threads that do would wait for each other.
  (void)pybind11::detail::npy_api::get();
  wait_at_exit();
  bind_errors(m);
  bind_build_info(m);
  bind_scene(m);
  bind_columns(m);
  bind_pose(m);
  bind_model(m);
  bind_solver(m);
  bind_run(m);
  bind_sweep(m);
  bind_laxity(m);
  bind_compare(m);
  bind_simulate(m);
  bind_calibrate(m);
  bind_study(m);
  bind_new_scene(m);
  bind_timings(m);
}
