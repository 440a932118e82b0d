#include "condyle/equilibrium/sweep.h"

#include <algorithm>

#include "condyle/equilibrium/sweep_sensitivities.h"
#include "condyle/input_error.h"
#include "condyle/python/arguments.h"
#include "condyle/python/bindings.h"
#include "condyle/python/interrupts.h"
#include "condyle/python/solver.h"
#include "condyle/python/study_arguments.h"
#include "condyle/scene/swept_quantity.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle::python {
namespace {

/// The scene of a model with the [sweep] of another text of it, where there is one, and with other values.
Scene scene_to_sweep(const Scene& scene, const py::object& text, const py::object& values) {
  Scene described = scene;
  if (!text.is_none()) {
    Scene other = parse_scene(py::cast<std::string>(text), scene.file);
    described.sweep = std::move(other.sweep);
    described.text = std::move(other.text);
  }
  if (!described.sweep)
    throw InputError("scene: [sweep] is missing, expected one, or vary = \"NAME\" and values");
  if (values.is_none()) return described;
  SweepDescription& sweep = *described.sweep;
  sweep.values = numbers(values, "values");
  const double unit = quantity_of_sweep(described).declared.factor;
  for (double& value : sweep.values) value *= unit;
  if (const std::string fault = fault_of_values(described); !fault.empty()) throw InputError(fault);
  return described;
}

std::shared_ptr<RunData> sweep_model(const py::object& scene_or_model,
                                     const py::object& values,
                                     const py::object& sweep_text,
                                     const py::object& progress) {
  const auto knee = model_of(scene_or_model);
  Run run;
  run.scene = scene_to_sweep(knee->scene(), sweep_text, values);
  if (!run.scene.sweep->sensitivities.empty())
    check_no_own_loads(*knee, "derivatives ([sweep] sensitivities)");
  const OnProgress tell = progress_of(progress);
  const Unlocked unlocked;
  const int total =
      run.scene.sweep->arc_length ? 0 : static_cast<int>(run.scene.sweep->values.size());
  int done = 0;
  Interrupts interrupts;
  SweepOptions options;
  options.on_pose = [&](const PoseResult&) {
    interrupts.check();
    ++done;
    if (tell) tell(done, total);
  };
  EquilibriumSolver solver(knee->model(), knee->covers(), equilibrium_options(run.scene));
  run.sweep = sweep(solver, *run.scene.sweep, options);
  run.sensitivities = sweep_sensitivities(run.scene, knee->fitted().surfaces, run.sweep.poses);
  return std::make_shared<RunData>(knee, std::move(run));
}

}  // namespace

void bind_sweep(py::module_& m) {
  m.def("sweep_model", &sweep_model, py::arg("scene_or_model"), py::arg("values"),
        py::arg("sweep_text"), py::arg("progress"), "condyle.sweep with the [sweep] of a text.");
}

}  // namespace condyle::python
