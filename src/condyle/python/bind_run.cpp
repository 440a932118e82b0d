#include "condyle/input_error.h"
#include "condyle/python/arguments.h"
#include "condyle/python/bindings.h"
#include "condyle/python/interrupts.h"
#include "condyle/results/make_run.h"
#include "condyle/results/output_file.h"
#include "condyle/results/run_view.h"
#include "condyle/results/sweep_table.h"

namespace condyle::python {
namespace {

using RunPointer = std::shared_ptr<RunData>;

const char* kind_name(RunKind kind) {
  constexpr const char* kNames[] = {"sweep",  "fit",        "comparison",
                                    "laxity", "simulation", "calibration"};
  return kNames[static_cast<std::size_t>(kind)];
}

/// The tree with a place. What a model's meshes say is made without the interpreter's lock, which a law of one's own may
/// want meanwhile in another thread.
const ColumnTree* tree_at(const RunPointer& run, const std::string& place) {
  if (run->model() && RunData::is_of_model(place)) {
    const Unlocked unlocked;
    (void)run->model()->empty_run();
  }
  return run->tree_at(place);
}

py::object place_in(const RunPointer& run, const std::string& place, long row = -1) {
  const std::string inside = place.substr(std::min(place.find_first_not_of('/'), place.size()));
  const ColumnTree* tree = tree_at(run, inside);
  if (tree == nullptr) throw py::key_error("\"" + inside + "\" is not in the run");
  return at_place(run, *tree, inside, row, run->computed().sweep.poses.size());
}

py::object of_sweep(const RunPointer& run, const char* place) {
  if (run->computed().sweep.poses.empty())
    throw InputError("a run of the kind \"" + std::string(kind_name(run->computed().kind())) +
                     "\" has no poses of its own, expected a sweep");
  return place_in(run, std::string("sweep/") + place);
}

py::object of_sweep_or_none(const RunPointer& run, const char* place) {
  const ColumnTree* tree = tree_at(run, std::string("sweep/") + place);
  const bool there = tree != nullptr && tree->group("sweep") != nullptr &&
                     tree->group("sweep")->group(place) != nullptr;
  return there ? of_sweep(run, place) : py::none();
}

py::object top_or_none(const RunPointer& run, const std::string& name) {
  return tree_at(run, name) == nullptr ? py::none() : place_in(run, name);
}

py::object converged(const RunPointer& run) {
  return of_sweep(run, "status").attr("__eq__")(py::int_(0));
}

py::object pose_at(const RunPointer& run, long index) {
  const auto count = static_cast<long>(run->computed().sweep.poses.size());
  const long row = index < 0 ? index + count : index;
  if (row < 0 || row >= count)
    throw py::index_error("pose " + std::to_string(index) + " of " + std::to_string(count));
  return place_in(run, "sweep", row);
}

py::object run_item(const RunPointer& run, const py::object& key) {
  if (py::isinstance<py::str>(key)) return place_in(run, py::cast<std::string>(key));
  const py::object index = py::reinterpret_steal<py::object>(PyNumber_Index(key.ptr()));
  if (!index) {
    PyErr_Clear();
    throw py::type_error("a run has poses by their number, and groups by their name");
  }
  const long number = PyLong_AsLong(index.ptr());
  if (number == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
  return pose_at(run, number);
}

void save(const RunPointer& run, const py::object& file) {
  const std::string name = path(file, "path");
  check_output_file(name, ".h5");
  if (run->model()) run->model()->fitted().knee.expect_writable("a file");
  Run complete;
  {
    const Unlocked unlocked;
    complete = run->complete();
  }
  refuse_to_overwrite_inputs(name, complete.scene);
  write_run(name, complete);  // under the interpreter's lock: HDF5 is not for several threads
}

RunPointer open_run(const py::object& file) {
  const std::string name = path(file, "path");
  RunWithColumns read = read_run_with_columns(name);
  return std::make_shared<RunData>(std::move(read.run), std::move(read.columns), name);
}

py::tuple lines(const std::vector<std::string>& all) {
  py::tuple out(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) out[i] = py::str(all[i]);
  return out;
}

py::tuple event_words(const RunData& run) {
  return lines(
      event_lines(run.computed().scene, swept_quantity(run.computed()), run.computed().sweep));
}

std::string run_repr(const RunData& run) {
  const SweepResult& sweep = run.computed().sweep;
  std::string text =
      "<condyle.Run \"" + run.computed().scene.title + "\": " + kind_name(run.computed().kind());
  if (!sweep.poses.empty())
    text += ", " + std::to_string(sweep.count_converged()) + " of " +
            std::to_string(sweep.poses.size()) + " poses converged";
  return text + ">";
}

void bind_studies(py::class_<RunData, RunPointer>& run) {
  run.def_property_readonly(
         "laxity", [](const RunPointer& r) { return top_or_none(r, "laxity"); },
         "Group of a test of laxity; None of other runs.")
      .def_property_readonly(
          "simulation", [](const RunPointer& r) { return top_or_none(r, "simulate"); },
          "Group of a motion; None of other runs.")
      .def_property_readonly(
          "calibration", [](const RunPointer& r) { return top_or_none(r, "calibrate"); },
          "Group of a calibration; None of other runs.")
      .def_property_readonly(
          "posterior", [](const RunPointer& r) { return top_or_none(r, "posterior"); },
          "Group of the samples of a calibration's posterior: samples (n, p), parameter, units; "
          "None where there are none.")
      .def_property_readonly(
          "comparison", [](const RunPointer& r) { return top_or_none(r, "compare"); },
          "Group of a comparison with Wismans' model; None of other runs.");
}

void bind_columns_of(py::class_<RunData, RunPointer>& run) {
  const auto property = [&](const char* name, const char* place, const char* doc) {
    run.def_property_readonly(
        name, [place](const RunPointer& r) { return of_sweep(r, place); }, doc);
  };
  property("values", "value",
           "What is swept at each pose, (n,) [deg, mm, or 1 for a factor on a load].");
  property("status", "status",
           "How the search of each pose ended, (n,) int32: see Status; 0 is converged.");
  property("reasons", "reason",
           "For each pose one line where it was not found, else an empty text; a tuple.");
  property("remarks", "remark", "For each pose what a reader should know; a tuple.");
  property("translation", "pose/translation",
           "Origin of the moving body in the ground frame, (n, 3) [mm].");
  property("rotation", "pose/rotation", "Rotation of the moving body, (n, 3, 3).");
  property("ligaments", "ligaments",
           "Group by name: force (n,) [N], length (n,) [mm], strain (n,).");
  property("contacts", "contacts",
           "Group by name: state (n,) (1 closed), force (n,) [N], point_ground (n, 3) [mm], gap "
           "(n,) [mm] ...,\n"
           "`points` with all its points; of elastic layers also pressures.");
  property("conditions", "conditions",
           "Group by name: value (n,) [deg or mm], multiplier (n,) [N mm or N].");
  property("stability", "stability", "Group: stable (n,), lowest_stiffness (n,) [N/mm].");
  property("newton", "newton", "Group: iterations (n,), residual (n,) [N], seconds (n,) ...");
  run.def_property_readonly(
         "joint", [](const RunPointer& r) { return of_sweep_or_none(r, "joint"); },
         "Group: flexion, adduction, internal_rotation (n,) [deg], lateral_shift, "
         "anterior_drawer,\n"
         "distraction (n,) [mm], stiffness and compliance (n, 6, 6); None without [joint].")
      .def_property_readonly(
          "sensitivities", [](const RunPointer& r) { return of_sweep_or_none(r, "sensitivities"); },
          "Group of derivatives, (n, parameters) each; None where [sweep] asks for none.")
      .def_property_readonly(
          "events", [](const RunPointer& r) { return top_or_none(r, "events"); },
          "Group of what happened to contacts between poses: value, kind, contact; see kind's "
          "`meaning`.")
      .def_property_readonly(
          "patches", [](const RunPointer& r) { return top_or_none(r, "patches"); },
          "Group by surface: degree, knots, control points, figures of the fit.")
      .def_property_readonly("converged", &converged,
                             "Which poses were found, (n,) bool; a new array each time.");
}

}  // namespace

void bind_run(py::module_& m) {
  py::class_<RunData, RunPointer> run(
      m, "Run",
      "What a command computes: a sweep, a fit, a comparison, a test of laxity, a motion, a "
      "calibration; computed here or\n"
      "opened from a file, the same object.\n\n"
      "Columns are numpy arrays with one row for each pose, in mm, N, N mm and deg whatever the "
      "scene's units, NaN where a\n"
      "pose was not found. They are made once, read-only, and keep the run alive; "
      "numpy.array(column) is a copy that can\n"
      "be written. run[i] is pose i as a Group; run[\"sweep/joint/flexion\"] any dataset of "
      "docs/results.md. Not to be\n"
      "pickled: save it.");
  only_returned(run);
  bind_columns_of(run);
  bind_studies(run);
  run.def_property_readonly(
         "kind", [](const RunData& r) { return kind_name(r.computed().kind()); },
         "\"sweep\", \"fit\", \"comparison\", \"laxity\", \"simulation\" or \"calibration\".")
      .def_property_readonly(
          "title", [](const RunData& r) { return r.computed().scene.title; }, "Title of the scene.")
      .def_property_readonly(
          "scene_text", [](const RunData& r) { return r.computed().scene.text; },
          "The scene as TOML.")
      .def_property_readonly(
          "swept", [](const RunData& r) { return swept_quantity(r.computed()).name; },
          "What goes from pose to pose: \"flexion\", \"drawer.scale\", \"time\".")
      .def_property_readonly(
          "file", [](const RunData& r) { return r.file(); },
          "Where it was read; \"\" for one made here.")
      .def_property_readonly("event_lines", &event_words,
                             "The events in words, one line each; a tuple.")
      .def("save", &save, py::arg("path"),
           "Write it as HDF5, as `condyle sweep` does: a whole file or none. Raises InputError "
           "where it cannot be written.")
      .def("__len__", [](const RunData& r) { return r.computed().sweep.poses.size(); })
      .def("__getitem__", &run_item, py::arg("key"))
      .def("__repr__", &run_repr);
  m.def("open_run", &open_run, py::arg("path"),
        "Open a result file (HDF5) of `condyle` or of Run.save.\n\n"
        "Returns a Run that holds all of it: the file may be removed. Raises InputError for what "
        "is missing, damaged, or no run.");
}

}  // namespace condyle::python
