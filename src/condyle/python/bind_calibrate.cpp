#include <climits>
#include <filesystem>
#include <optional>

#include "condyle/calibration/calibration_words.h"
#include "condyle/input_error.h"
#include "condyle/python/arguments.h"
#include "condyle/python/bindings.h"
#include "condyle/python/interrupts.h"
#include "condyle/python/study_arguments.h"
#include "condyle/results/calibration_journal.h"
#include "condyle/results/journal.h"
#include "condyle/results/make_run.h"
#include "condyle/results/output_file.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle::python {
namespace {

using TellStage = std::function<void(const std::string& stage, int done, int total)>;

TellStage stages_of(const py::object& progress) {
  if (progress.is_none()) return {};
  if (PyCallable_Check(progress.ptr()) == 0)
    throw py::type_error("progress: expected a function of (stage, done, total), or None");
  return [progress](const std::string& stage, int done, int total) {
    const py::gil_scoped_acquire lock;
    progress(stage, done, total);
  };
}

/// The best numbers so far, beside the result that is to be written; nothing where there is none.
class BestSoFar {
 public:
  BestSoFar(const std::string& output, bool resume, const Scene& scene, const KneeModel& knee) {
    if (output.empty()) return;
    check_output_file(output, ".h5");
    refuse_to_overwrite_inputs(output, scene);
    const std::filesystem::path path = journal_path(output);
    expect_calibration_journal(path);
    const CalibrationIdentity identity = calibration_identity(scene, knee.fitted().surfaces);
    file_.emplace(path, output);
    if (resume) earlier_ = read_calibration_journal(path, identity, scene);
    journal_.emplace(*file_, identity, earlier_.whole_bytes);
  }
  [[nodiscard]] const std::optional<Eigen::VectorXd>& earlier() const { return earlier_.best; }
  void append(const Eigen::VectorXd& theta, double cost) {
    if (journal_) journal_->append(theta, cost);
  }
  /// The result is written: it is no longer needed.
  void end() {
    if (!journal_) return;
    const std::string failure = journal_->failure();
    journal_->remove();
    if (!failure.empty() && PyErr_WarnEx(PyExc_RuntimeWarning, failure.c_str(), 1) != 0)
      throw py::error_already_set();
  }

 private:
  std::optional<LineFile> file_;
  std::optional<CalibrationJournal> journal_;
  CalibrationContents earlier_;
};

std::optional<int> count_or_none(const py::object& value, const char* argument, int least) {
  constexpr int kMost = 1000000;
  if (value.is_none()) return std::nullopt;
  return static_cast<int>(whole_number(value, argument, least, kMost));
}

/// Ctrl-C, and what `tell` throws, end it.
std::shared_ptr<const CalibrationResult> calibrate_interruptibly(const Scene& scene,
                                                                 const KneeModel& knee,
                                                                 CalibrationOptions options,
                                                                 const TellStage& tell) {
  std::shared_ptr<const CalibrationResult> result;
  run_interruptibly([&](const std::function<bool()>& should_stop) {
    std::exception_ptr raised;
    options.on_progress = [&](const std::string& stage, int done, int total) {
      try {
        if (tell && !should_stop()) tell(stage, done, total);
      } catch (...) {
        raised = std::current_exception();
      }
      return !raised && !should_stop();
    };
    const std::vector<FittedSurface>& surfaces = knee.fitted().surfaces;
    result = std::make_shared<const CalibrationResult>(calibrate(
        scene, surfaces, read_measurements(scene), body_meshes(scene, surfaces), options));
    if (raised) std::rethrow_exception(raised);
  });
  return result;
}

std::shared_ptr<RunData> calibrate_scene(const py::object& scene_or_model,
                                         const py::object& starts,
                                         const py::object& samples,
                                         const py::object& seed,
                                         bool suggest,
                                         const py::object& threads,
                                         const py::object& output,
                                         bool resume,
                                         const py::object& progress) {
  CalibrationOptions options;
  options.suggest = suggest;
  options.starts = count_or_none(starts, "starts", 1);
  options.samples = count_or_none(samples, "samples", 0);
  options.threads = threads_of(threads);
  const TellStage tell = stages_of(progress);
  const std::string file = output.is_none() ? "" : path(output, "output");
  if (resume && file.empty())
    throw InputError("resume = True, expected output, beside which an earlier run left its best");
  const auto knee = model_without_own_loads(scene_or_model, "a calibration");
  Scene scene = knee->scene();
  if (!scene.calibration)
    throw InputError(scene.file.string() +
                     ": [calibrate] is missing, expected the table of measurements");
  if (!seed.is_none())
    scene.calibration->seed = static_cast<unsigned>(whole_number(seed, "seed", 0, UINT_MAX));
  if (!file.empty()) knee->fitted().knee.expect_writable("a file");
  BestSoFar best(file, resume, scene, *knee);
  options.from = best.earlier();
  options.on_better = [&](const Eigen::VectorXd& theta, double cost) { best.append(theta, cost); };
  Run run;
  run.scene = knee->scene();
  run.study = calibrate_interruptibly(scene, *knee, options, tell);
  auto found = std::make_shared<RunData>(knee, std::move(run));
  if (!file.empty()) write_run(file, found->complete());
  best.end();
  return found;
}

py::tuple fitted_scene(const RunData& run) {
  const CalibrationResult* result = run.computed().calibration();
  if (result == nullptr) throw InputError("run: not of a calibration, expected one");
  if (run.model()) run.model()->fitted().knee.expect_writable("a scene file");
  const Scene& scene = run.computed().scene;
  return py::make_tuple(fitted_scene_text(scene, *result), scene.file.string());
}

}  // namespace

void bind_calibrate(py::module_& m) {
  m.def("calibrate", &calibrate_scene, py::arg("scene"), py::kw_only(),
        py::arg("starts") = py::none(), py::arg("samples") = py::none(),
        py::arg("seed") = py::none(), py::arg("suggest") = false, py::arg("threads") = py::none(),
        py::arg("output") = py::none(), py::arg("resume") = false, py::arg("progress") = py::none(),
        "Fit numbers of the knee to measurements, and say what these determine: what `condyle "
        "calibrate` computes.\n\n"
        "scene: a Scene with [calibrate], of which a Model is made, or a Model.\n"
        "starts, samples, seed: of the search and of the posterior, in place of the scene's.\n"
        "suggest: rank tests that were not made.\n"
        "threads: how many; one a core where None. The same bits with any number.\n"
        "output: a result file (HDF5) to write. While it is computed the best numbers so far stand "
        "beside it; after Ctrl-C or\n"
        "a crash resume=True goes on from them.\n"
        "progress: a function of (stage, done, total), `stage` a text.\n\n"
        "Returns a Run whose `calibration` is a Group: parameters.name, start, prior_sd, mean, sd "
        "(p,) [units: mm, deg, 1],\n"
        "covariance (p, p), rows.value, sd, before, after (r,), agreements, figures, bands.flexion "
        "(f,) [deg], before, before_sd,\n"
        "after, after_sd (b, f) [deg, mm or N], profiles, starts, suggested (docs/results.md). Its "
        "`posterior` has samples\n"
        "(n, p). condyle.fitted_scene(run) is the scene with the fitted numbers. Raises InputError "
        "for bad input. A fit that\n"
        "does not converge says so in calibration.figures. Other threads go on meanwhile; Ctrl-C "
        "ends it.");
  m.def("fitted_scene_text", &fitted_scene, py::arg("run"),
        "The text of condyle.fitted_scene, and the file that its paths are told from.");
}

}  // namespace condyle::python
