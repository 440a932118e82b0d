#include "condyle/app/resume.h"

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "condyle/input_error.h"

namespace condyle {
namespace {

std::vector<KnownPose> poses_of_run(const std::filesystem::path& output,
                                    const Scene& scene,
                                    const std::vector<FittedSurface>& surfaces) {
  std::error_code unknown;
  if (!std::filesystem::exists(output, unknown)) return {};
  const Run run = read_run(output);
  if (run.kind() == RunKind::kCalibration)
    throw InputError(output.string() + ": is a calibration, expected the result of condyle sweep");
  expect_same_scene(output.string(), run, scene, surfaces);
  return known_poses(run.sweep);
}

void expect_same_identity(const std::string& file,
                          const RunIdentity& there,
                          const RunIdentity& here,
                          const Scene& scene) {
  if (there.scene != here.scene) {
    throw InputError(fmt::format("{}: belongs to another text of the scene, expected that of {}",
                                 file, scene.file.string()));
  }
  if (there.surfaces != here.surfaces) {
    throw InputError(
        file +
        ": belongs to other patches, expected those fitted now (a mesh has changed, or "
        "the program)");
  }
}

}  // namespace

EarlierPoses earlier_poses(const std::filesystem::path& output,
                           bool resume,
                           const Scene& scene,
                           const std::vector<FittedSurface>& surfaces) {
  const std::string file = journal_path(output).string();
  JournalContents journal = read_journal(file, scene);
  const std::size_t in_journal = journal.poses.size();
  const RunIdentity here = identity(scene, surfaces);
  EarlierPoses earlier;
  if (!resume) {
    if (in_journal > 0 && journal.identity == here) {
      earlier.message = fmt::format(
          "{} holds {} poses of a run that was stopped: --resume would have gone on with it, this "
          "run starts anew",
          file, in_journal);
    }
    return earlier;
  }
  if (journal.started) expect_same_identity(file, journal.identity, here, scene);
  earlier.poses = poses_of_run(output, scene, surfaces);
  const std::size_t in_run = earlier.poses.size();
  earlier.journal_bytes = journal.whole_bytes;
  earlier.poses.insert(earlier.poses.end(), std::make_move_iterator(journal.poses.begin()),
                       std::make_move_iterator(journal.poses.end()));
  earlier.message =
      earlier.poses.empty()
          ? fmt::format("nothing to resume from in {}, starting anew", output.string())
          : fmt::format("resuming with {} poses of {} and {} of its journal", in_run,
                        output.string(), in_journal);
  return earlier;
}

}  // namespace condyle
