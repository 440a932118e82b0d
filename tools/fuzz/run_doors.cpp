/// Results: as they come, and whole ones with parts altered (run_alterations.h). What is read is shown in
/// every way that needs no picture.

#include <stdexcept>

#include "condyle/exchange/csv_run.h"
#include "condyle/exchange/glb_run.h"
#include "condyle/exchange/opensim_run.h"
#include "condyle/exchange/pressure_export.h"
#include "condyle/exchange/stl_run.h"
#include "condyle/exchange/vtk_run.h"
#include "condyle/report/report_page.h"
#include "condyle/report/study_json.h"
#include "condyle/report/study_page.h"
#include "condyle/report/summary_json.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/results/hdf5_group.h"
#include "condyle/results/rehearsal.h"
#include "condyle/results/run_identity.h"
#include "condyle/results/study_file.h"
#include "condyle/results/sweep_table.h"
#include "condyle/verify/verify.h"
#include "fuzz/door_list.h"
#include "fuzz/memory_file.h"
#include "fuzz/refusal.h"
#include "fuzz/run_alterations.h"

namespace condyle::fuzz {
namespace {

void summarise(const Run& run) {
  (void)json_summary({}, run);
  const SweptQuantity swept = swept_quantity(run);
  for (const std::string& line : failures(swept, run.sweep)) expect_one_line(line);
  for (const std::string& line : event_lines(run.scene, swept, run.sweep)) expect_one_line(line);
  const SweepTable table(run.scene, swept);
  for (const PoseResult& pose : run.sweep.poses) (void)table.row(pose);
}

void verify(const Run& run, const std::filesystem::path& file) {
  const Hdf5Reader reader(file);
  const ColumnTree columns = read_columns(reader.root());
  const Verification verification =
      verify_run(run, {.pushes = true, .on_pose = {}, .columns = &columns});
  (void)json_verification({}, run, verification);
}

void export_numbers(const Run& run) {
  const std::vector<ShownPose> shown = shown_poses(run, "run.h5");
  (void)csv_of_poses(run, shown);
  if (has_layers(run)) (void)csv_of_pressures(run, shown);
  (void)sto_of_poses(run, shown);
  (void)mot_of_poses(run, shown, "run.h5");
}

void export_shapes(const Run& run) {
  const std::vector<ShownPose> shown = shown_poses(run, "run.h5");
  const ShapeOptions coarse = {.patch_spacing = 6};
  const std::vector<RunShape> shapes = run_shapes(run, coarse);
  (void)vtk_of_poses(run, shown, shapes, "run");
  (void)stl_of_poses(run, shown, shapes, "run");
  (void)glb_of_poses(run, shown, coarse);
}

/// What shows numbers, always; what takes a hundred times as long (a page has its run verified), by a hash of the bytes.
void show(const Run& run, const std::filesystem::path& file, std::uint64_t turn) {
  taken([&] { summarise(run); });
  taken([&] { export_numbers(run); });
  if (turn % 8 == 4)
    taken([&] { (void)report_page(run, "run.h5", {.pictures = false, .on_part = {}}); });
  if (turn % 16 == 0) taken([&] { verify(run, file); });
  if (turn % 16 == 8) taken([&] { export_shapes(run); });
}

void show(const StudyView& study, const std::filesystem::path&, std::uint64_t) {
  (void)json_study({}, study);
  (void)study_page(study, "study.h5", {.pictures = false, .on_part = {}});
}

/// HDF5 wants a name that stays what it is when links are resolved: no file in memory.
std::filesystem::path file_of(const std::string& bytes) {
  write_scratch("run.h5", bytes);
  return scratch() / "run.h5";
}

}  // namespace

void open_run(Bytes bytes) {
  const std::string text = text_of(bytes);
  const std::filesystem::path file = file_of(text);
  const std::uint64_t turn = hash_bytes(text);
  taken([&] {
    is_study_file(file) ? show(read_study_file(file), file, turn)
                        : show(read_run(file), file, turn);
  });
}

/// HDF5 has written the file itself, so what goes wrong goes wrong behind it.
void open_altered_run(Bytes bytes) {
  Choices choices(bytes);
  const std::filesystem::path file = file_of(altered_run(choices));
  const std::uint64_t turn = hash_bytes(text_of(bytes));
  if (!taken([&] { show(read_run_at_once(file), file, turn); }))
    taken([&] { show(read_study_file_at_once(file), file, turn); });
}

}  // namespace condyle::fuzz
