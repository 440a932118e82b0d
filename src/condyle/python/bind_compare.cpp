#include "condyle/compare/compare.h"

#include "condyle/equilibrium/sweep.h"
#include "condyle/python/bindings.h"
#include "condyle/python/interrupts.h"
#include "condyle/python/study_arguments.h"

namespace condyle::python {
namespace {

std::shared_ptr<RunData> compare_models(const py::object& scene,
                                        const py::object& degree,
                                        const py::object& strain,
                                        const py::object& progress) {
  const CompareOptions options = reference_options(degree, strain);
  const OnProgress tell = progress_of(progress);
  const auto knee = model_without_own_loads(scene, "a comparison");
  Run run;
  run.scene = knee->scene();
  check_compared_scene(run.scene);
  const std::vector<FittedSurface>& surfaces = knee->fitted().surfaces;
  run_interruptibly(tell, [&](const OnProgress& on_sweep) {
    run.sweep = sweep(run.scene, surfaces);
    run.study = std::make_shared<const Comparison>(
        compare(run.scene, surfaces, run.sweep, options, on_sweep));
  });
  return std::make_shared<RunData>(knee, std::move(run));
}

}  // namespace

void bind_compare(py::module_& m) {
  m.def("compare", &compare_models, py::arg("scene"), py::kw_only(),
        py::arg("degree") = kUsualDegree, py::arg("strain") = kUsualMatchedStrain,
        py::arg("progress") = py::none(),
        "Wismans' model of the same specimen beside ours, over the scene's sweep: what `condyle "
        "compare` computes.\n\n"
        "scene: a Scene with [sweep] in steps, of which a Model is made, or a Model.\n"
        "degree: total degree of the polynomials that stand for its patches.\n"
        "strain: at which its quadratic springs have the force of toe-linear bundles.\n"
        "progress: a function of (done, total) sweeps.\n\n"
        "Returns a Run of our sweep with n poses. Its `comparison` is a Group: "
        "quantities[\"adduction\"] and others, each with\n"
        "ours, reference, surfaces, springs, closed, all_three (n,) [deg, mm or N], the steps from "
        "one model to the other;\n"
        "converged (6,), seconds (2,) [s], iterations (2,). run[\"reference/sweep/...\"] are the "
        "poses of Wismans' model. Raises\n"
        "InputError for a scene that his model cannot hold. Other threads go on meanwhile; Ctrl-C "
        "ends it after a sweep.");
}

}  // namespace condyle::python
