#include "condyle/compare/laxity.h"
#include "condyle/python/bindings.h"
#include "condyle/python/interrupts.h"
#include "condyle/python/study_arguments.h"

namespace condyle::python {
namespace {

std::shared_ptr<RunData> laxity(const py::object& scene,
                                const py::object& degree,
                                const py::object& strain,
                                const py::object& progress) {
  const CompareOptions options = reference_options(degree, strain);
  const OnProgress tell = progress_of(progress);
  const auto knee = model_without_own_loads(scene, "a test of laxity");
  Run run;
  run.scene = knee->scene();
  check_laxity_scene(run.scene);
  run_interruptibly(tell, [&](const OnProgress& on_curve) {
    run.study = std::make_shared<const LaxityResult>(
        test_laxity(run.scene, knee->fitted().surfaces, options, on_curve));
  });
  return std::make_shared<RunData>(knee, std::move(run));
}

}  // namespace

void bind_laxity(py::module_& m) {
  m.def("laxity", &laxity, py::arg("scene"), py::kw_only(), py::arg("degree") = kUsualDegree,
        py::arg("strain") = kUsualMatchedStrain, py::arg("progress") = py::none(),
        "A test of laxity: the load of [sweep] goes over its values at each flexion of [laxity], "
        "in the knee as it is and\n"
        "with some ligaments cut; what `condyle laxity` computes.\n\n"
        "scene: a Scene with [laxity], of which a Model is made, or a Model.\n"
        "degree, strain: how Wismans' model is made of it, where it can hold the scene: total "
        "degree of its polynomials,\n"
        "and the strain at which its springs have the force of toe-linear bundles.\n"
        "progress: a function of (done, total) curves.\n\n"
        "Returns a Run whose `laxity` is a Group: flexion (f,) [deg], scale (k,), load (k,) [N or "
        "N mm], and intact.ours,\n"
        "cut.ours and, by Wismans' model, intact.reference, cut.reference, each with status (f, "
        "k), joint.anterior_drawer ...\n"
        "(f, k) [mm or deg], ligaments[\"aACL\"] and contacts[\"medial\"] (f, k) [N], NaN where a "
        "pose was not found. Raises\n"
        "InputError for bad input. Other threads go on meanwhile; Ctrl-C ends it after a curve.");
}

}  // namespace condyle::python
