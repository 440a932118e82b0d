#include <climits>

#include "condyle/input_error.h"
#include "condyle/python/arguments.h"
#include "condyle/python/bindings.h"
#include "condyle/python/compute_study.h"
#include "condyle/python/study_arguments.h"
#include "condyle/results/study_words.h"
#include "condyle/scene_file/read_study.h"

namespace condyle::python {
namespace {

using StudyPointer = std::shared_ptr<StudyColumns>;

/// A text is told from a path by its lines.
ReadStudy study_of(const py::object& study, const py::object& folder) {
  if (py::isinstance<py::str>(study)) {
    const auto text = py::cast<std::string>(study);
    if (text.find('\n') != std::string::npos)
      return parse_study(text, std::filesystem::path(path(folder, "folder")) / "<text>");
  }
  return read_study(path(study, "study"));
}

void change_as_asked(const py::object& samples, const py::object& seed, StudyDescription& study) {
  constexpr long long kMost = 1LL << 53;
  if (!seed.is_none())
    study.seed = static_cast<std::uint64_t>(whole_number(seed, "seed", 0, LLONG_MAX));
  if (samples.is_none()) return;
  const long long count = whole_number(samples, "samples", 1, kMost);
  if (study.design == DesignKind::kGrid)
    throw InputError("samples = " + std::to_string(count) + ": the design of " +
                     study.file.string() + " is a grid, expected levels there");
  study.samples = static_cast<long>(count);
}

StudyPointer compute(const py::object& study,
                     const py::object& folder,
                     const py::object& output,
                     const py::object& samples,
                     const py::object& seed,
                     const py::object& threads,
                     bool resume,
                     const py::object& progress) {
  StudyToCompute asked;
  asked.threads = threads_of(threads);
  asked.resume = resume;
  if (!output.is_none()) asked.output = path(output, "output");
  if (resume && asked.output.empty())
    throw InputError("resume = True, expected output, beside which an earlier run left its chunks");
  const OnProgress tell = progress_of(progress);
  asked.read = study_of(study, folder);
  change_as_asked(samples, seed, asked.read.study);
  return compute_study(std::move(asked), tell);
}

py::object place_in_study(const StudyPointer& study, const std::string& place) {
  const std::string inside = place.substr(std::min(place.find_first_not_of('/'), place.size()));
  return at_place(study, study->tree_at(inside), inside);
}

py::tuple texts_of(const std::vector<std::string>& all) {
  py::tuple out(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) out[i] = py::str(all[i]);
  return out;
}

std::string study_repr(const StudyColumns& study) {
  const StudyView& view = study.view();
  return "<condyle.Study \"" + view.title + "\": " + std::to_string(view.samples) + " samples of " +
         std::to_string(view.parameters.size()) + " numbers, " + view.design + ">";
}

void bind_study_columns(py::class_<StudyColumns, StudyPointer>& study) {
  const auto property = [&](const char* name, const char* place, const char* doc) {
    study.def_property_readonly(
        name, [place](const StudyPointer& s) { return place_in_study(s, place); }, doc);
  };
  property("values", "sweep/value", "What is swept, (p,) [deg, mm, or 1 for a factor on a load].");
  property("theta", "samples/theta",
           "The numbers of each sample, (n, d): changes from the scene [units of parameters], of "
           "logarithms where\n"
           "parameters.logarithmic is 1.");
  property("parameters", "samples/parameters",
           "Group of what varies: name, units, spread (d texts), logarithmic, typical (d,): their "
           "standard deviation.");
  property("outputs", "outputs",
           "Group of all samples by quantity, (n, p) each [mm, deg or N], NaN where a pose was not "
           "found; `status` (n, p).\n"
           "All of them are read; study[\"outputs/aACL.force\"] reads that one alone.");
  property("bands", "bands",
           "Group by quantity: mean, sd, nominal (p,), quantiles (5, p) of 5, 25, 50, 75, 95 % "
           "[mm, deg or N], samples (p,).");
  property("indices", "indices",
           "Group by quantity: rank (d, p), Spearman's correlation with each number; of a design "
           "\"saltelli\" of one knee also\n"
           "Sobol's first and total (d, p, 3): the index and both ends of its 95 % interval.");
  property("failures", "failures",
           "Group: poses, failed, incomplete (1,), by_pose (p,), by_status (p, 16), by_quartile "
           "(d, 4).");
}

}  // namespace

void bind_study(py::module_& m) {
  py::class_<StudyColumns, StudyPointer> study(
      m, "Study",
      "A study: many samples of one knee or of many, each swept; computed here or opened from a "
      "file, the same object.\n\n"
      "n samples of all knees, d numbers that vary, p poses. Columns are numpy arrays, read-only, "
      "under the names of\n"
      "docs/results.md: study[\"bands/aACL.force/mean\"]; of several knees also "
      "study[\"knees/NAME/bands\"]. They keep the\n"
      "study alive; its file may be removed meanwhile.");
  only_returned(study);
  bind_study_columns(study);
  study
      .def_property_readonly(
          "title", [](const StudyColumns& s) { return s.view().title; }, "Title of the study.")
      .def_property_readonly(
          "study_text", [](const StudyColumns& s) { return s.view().text; }, "The study as TOML.")
      .def_property_readonly(
          "design", [](const StudyColumns& s) { return s.view().design; },
          "How samples are spread: \"saltelli\", \"sobol\" ...")
      .def_property_readonly(
          "swept", [](const StudyColumns& s) { return s.view().swept.name; },
          "What goes from pose to pose: \"flexion\", \"drawer.scale\".")
      .def_property_readonly(
          "knees", [](const StudyColumns& s) { return texts_of(s.view().knees); },
          "Names of the knees; a tuple.")
      .def_property_readonly(
          "lines", [](const StudyColumns& s) { return texts_of(study_lines(s.view())); },
          "What `condyle study` says of it, a line each; a tuple.")
      .def("__len__", [](const StudyColumns& s) { return s.view().samples; })
      .def("__getitem__", &place_in_study, py::arg("place"))
      .def("__repr__", &study_repr);
  m.def("study", &compute, py::arg("study"), py::kw_only(), py::arg("folder") = ".",
        py::arg("output") = py::none(), py::arg("samples") = py::none(),
        py::arg("seed") = py::none(), py::arg("threads") = py::none(), py::arg("resume") = false,
        py::arg("progress") = py::none(),
        "Sweep many samples of knees, and say what varies with what: what `condyle study` "
        "computes.\n\n"
        "study: the path of a study file (TOML, docs/study.md), or its text, of several lines.\n"
        "folder: where paths of a text start.\n"
        "output: a result file (HDF5) to write; None: a temporary one, which lives as long as the "
        "Study. While it is\n"
        "computed what is done stands beside it; after Ctrl-C or a crash resume=True goes on from "
        "there.\n"
        "samples, seed: in place of the study's. threads: how many; one a core where None. The "
        "same bits with any number.\n"
        "progress: a function of (done, total) samples, called some times a second.\n\n"
        "Returns a Study. Raises InputError for bad input; poses that are not found are counted "
        "(failures). Other threads go\n"
        "on meanwhile, but while the result is written; Ctrl-C ends it.");
  m.def(
      "open_study", [](const py::object& file) { return open_study(path(file, "path")); },
      py::arg("path"),
      "Open the result (HDF5) of `condyle study`, or of condyle.study with output.\n\n"
      "Returns a Study. Raises InputError for what is missing, damaged, or no study.");
}

}  // namespace condyle::python
