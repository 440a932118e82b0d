#include "condyle/network/simulate.h"
#include "condyle/python/bindings.h"
#include "condyle/python/interrupts.h"
#include "condyle/python/study_arguments.h"

namespace condyle::python {
namespace {

std::shared_ptr<RunData> simulate_motion(const py::object& scene, const py::object& progress) {
  const OnProgress tell = progress_of(progress);
  const auto knee = model_without_own_loads(scene, "a motion");
  Run run;
  run.scene = knee->scene();
  check_simulated_scene(run.scene);
  run_interruptibly(tell, [&](const OnProgress& on_frame) {
    const auto simulation =
        std::make_shared<const Simulation>(simulate(run.scene, knee->fitted().surfaces, on_frame));
    run.sweep.poses = simulation->poses;
    run.study = simulation;
  });
  return std::make_shared<RunData>(knee, std::move(run));
}

}  // namespace

void bind_simulate(py::module_& m) {
  m.def("simulate", &simulate_motion, py::arg("scene"), py::kw_only(),
        py::arg("progress") = py::none(),
        "Release, strike or drive the knee and follow its motion in time: what `condyle simulate` "
        "computes.\n\n"
        "scene: a Scene with [simulate], of which a Model is made, or a Model.\n"
        "progress: a function of (done, total) frames.\n\n"
        "Returns a Run whose n poses are the frames; `values` are their times [s]. Its "
        "`simulation` is a Group: time (n,) [s],\n"
        "velocity (n, 3) [mm/s] and angular_velocity (n, 3) [deg/s] of the mass centre in the "
        "ground frame, energy.kinetic,\n"
        "gravity, ligaments, layers, dissipated, driver_work and balance (n,) [J], events (time, "
        "contact, closing, speed), mass\n"
        "[kg], mass_center (3,) [mm]. A motion that stops has fewer frames. Raises InputError for "
        "bad input, a body without\n"
        "mass, a start that is no equilibrium. Other threads go on meanwhile; Ctrl-C ends it.");
}

}  // namespace condyle::python
