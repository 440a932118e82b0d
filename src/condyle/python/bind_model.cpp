#include "condyle/python/arguments.h"
#include "condyle/python/bindings.h"
#include "condyle/python/interrupts.h"
#include "condyle/python/solver.h"
#include "condyle/results/run_columns.h"

namespace condyle::python {
namespace {

/// A method that is given the pointer cannot be called on an object without __init__; a reference it could.
using ModelPointer = std::shared_ptr<KneeModel>;

/// The columns of patches and their figures, of a fitted knee without poses.
struct Surfaces {
  std::shared_ptr<const FittedKnee> fitted;
  std::shared_ptr<const ColumnTree> tree;
};

std::shared_ptr<const FittedKnee> fit_interruptibly(const KneeScene& scene,
                                                    const OnProgress& progress) {
  std::shared_ptr<const FittedKnee> fitted;
  run_interruptibly(progress,
                    [&](const OnProgress& on_patch) { fitted = fit_knee(scene, on_patch); });
  return fitted;
}

/// A run of nothing but patches, for their columns.
ColumnTree patch_columns(const FittedKnee& fitted) {
  Run run;
  run.scene = fitted.knee.scene;
  run.study = FitStudy{};
  for (std::size_t i = 0; i < fitted.surfaces.size(); ++i) {
    const auto* patch = dynamic_cast<const Patch*>(fitted.surfaces[i].surface.get());
    if (patch == nullptr) continue;
    const SurfaceDescription& surface = run.scene.surfaces[i];
    run.patches.push_back({surface.name, surface.body, patch->data(),
                           fitted.surfaces[i].report.value_or(FitReport{})});
  }
  return columns_of(run);
}

Surfaces fit(const py::object& scene, const py::object& progress) {
  const auto knee = scene_of(scene);
  auto fitted = fit_interruptibly(*knee, progress_of(progress));
  auto tree = std::make_shared<const ColumnTree>(patch_columns(*fitted));
  return {std::move(fitted), std::move(tree)};
}

py::object patches(const Surfaces& surfaces) {
  return at_place(surfaces.tree, *surfaces.tree, "patches");
}

std::shared_ptr<KneeModel> make_model(const py::object& scene,
                                      const py::object& surfaces,
                                      const py::object& progress) {
  std::shared_ptr<const FittedKnee> fitted;
  const auto knee = scene_of(scene);
  if (surfaces.is_none()) {
    fitted = fit_interruptibly(*knee, progress_of(progress));
  } else {
    if (!py::isinstance<Surfaces>(surfaces))
      throw py::type_error("surfaces: expected what condyle.fit returns, or None");
    fitted = with_surfaces_of(*py::cast<const Surfaces&>(surfaces).fitted, *knee);
  }
  std::shared_ptr<KneeModel> model;
  run_interruptibly(
      [&](const std::function<bool()>&) { model = std::make_shared<KneeModel>(fitted); });
  return model;
}

template <typename T>
py::tuple names_of(const std::vector<T>& items) {
  py::tuple names(items.size());
  for (std::size_t i = 0; i < items.size(); ++i) names[i] = py::str(items[i].name);
  return names;
}

}  // namespace

std::shared_ptr<const KneeModel> model_of(const py::object& scene_or_model) {
  if (py::isinstance<KneeModel>(scene_or_model))
    return py::cast<std::shared_ptr<KneeModel>>(scene_or_model);
  if (py::isinstance<KneeSolver>(scene_or_model))
    throw py::type_error(
        "scene: condyle.Solver, expected a condyle.Scene or a condyle.Model: with the numbers set "
        "in a solver poses are solved one by one");
  return make_model(scene_or_model, py::none(), py::none());
}

void bind_model(py::module_& m) {
  py::class_<Surfaces> surfaces(
      m, "Surfaces",
      "The surfaces of a scene that can be evaluated, as condyle.fit returns "
      "them: for Model(scene, surfaces).");
  only_returned(surfaces);
  surfaces.def_property_readonly(
      "patches", &patches,
      "Group: for each patch degree, knots, control points and, in `fit`, "
      "the figures of its fit [mm].");
  m.def("fit", &fit, py::arg("scene"), py::arg("progress") = py::none(),
        "Fit the patches of a scene to its meshes.\n\n"
        "scene: a Scene. progress: a function of (done, total) patches.\n"
        "Returns Surfaces, for Model(scene, surfaces). Raises InputError for meshes that cannot be "
        "used. Takes a second\n"
        "or so; Ctrl-C ends it.");
  py::class_<KneeModel, ModelPointer>(
      m, "Model",
      "A knee that can be solved: constant, shared by any number of threads.\n\n"
      "Model(scene, surfaces=None, *, progress=None): `surfaces` as from condyle.fit(scene), else "
      "they are fitted here.\n"
      "Solver(model) is the workspace of one thread.")
      .def(py::init(&make_model), py::arg("scene"), py::arg("surfaces") = py::none(), py::kw_only(),
           py::arg("progress") = py::none())
      .def("solve", &solve_once, py::arg("drive") = py::none(), py::pos_only(),
           "The position of equilibrium, from the scene's start pose: what was solved before does "
           "not matter.\n\n"
           "solve(flexion=30, drawer=0.5), or solve({\"body weight.scale\": 2}): values of "
           "conditions in the scene's\n"
           "units (deg or rad, mm ...) and factors on loads, by name or NAME.scale; what is not "
           "given has the scene's\n"
           "value. Returns a Pose; one that is not found says so in its status. Any number of "
           "threads may call it at once.")
      .def_property_readonly(
          "title", [](const ModelPointer& model) { return model->scene().title; },
          "Title of the scene.")
      .def_property_readonly(
          "scene_text", [](const ModelPointer& model) { return model->scene().text; },
          "The scene as TOML.")
      .def_property_readonly(
          "warnings",
          [](const ModelPointer& model) {
            {
              const Unlocked unlocked;
              (void)model->empty_run();
            }
            const std::vector<std::string>& start = model->empty_run().start;
            py::tuple lines(start.size());
            for (std::size_t i = 0; i < start.size(); ++i) lines[i] = py::str(start[i]);
            return lines;
          },
          "What `condyle check` says of the start pose, one line each; what matters begins with "
          "\"warning: \".")
      .def_property_readonly(
          "ligaments", [](const ModelPointer& model) { return names_of(model->scene().ligaments); },
          "Names of the ligaments, in the scene's order.")
      .def_property_readonly(
          "contacts", [](const ModelPointer& model) { return names_of(model->scene().contacts); },
          "Names of the contacts.")
      .def_property_readonly(
          "conditions",
          [](const ModelPointer& model) { return names_of(model->scene().conditions); },
          "Names of the prescribed motions.")
      .def_property_readonly(
          "loads", [](const ModelPointer& model) { return names_of(model->scene().loads); },
          "Names of the loads.")
      .def("__repr__", [](const ModelPointer& model) {
        return "<condyle.Model \"" + model->scene().title +
               "\": " + std::to_string(model->scene().ligaments.size()) + " ligaments, " +
               std::to_string(model->scene().contacts.size()) + " contacts>";
      });
}

}  // namespace condyle::python
