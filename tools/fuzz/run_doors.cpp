/// Results: as they come, and whole ones with parts altered (run_alterations.h). What is read is shown in
/// every way that starts no other program.

#include <algorithm>
#include <array>
#include <stdexcept>

#include "condyle/exchange/csv_run.h"
#include "condyle/exchange/glb_run.h"
#include "condyle/exchange/opensim_run.h"
#include "condyle/exchange/pressure_export.h"
#include "condyle/exchange/stl_run.h"
#include "condyle/exchange/vtk_run.h"
#ifdef CONDYLE_PICTURES
#include "condyle/pictures/knee_picture.h"
#include "condyle/pictures/plot_run.h"
#include "condyle/pictures/plot_study.h"
#endif
#include "condyle/report/report_page.h"
#include "condyle/report/study_json.h"
#include "condyle/report/study_page.h"
#include "condyle/report/summary_json.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/results/hdf5_group.h"
#include "condyle/results/run_file.h"
#include "condyle/results/run_identity.h"
#include "condyle/results/run_view.h"
#include "condyle/results/study_file.h"
#include "condyle/results/sweep_table.h"
#include "condyle/verify/verify.h"
#include "fuzz/door_list.h"
#include "fuzz/memory_file.h"
#include "fuzz/refusal.h"
#include "fuzz/run_alterations.h"

namespace condyle::fuzz {
namespace {

struct Source {
  std::filesystem::path file;
  ReadBy by;
};

void summarise(const Run& run) {
  (void)json_summary({}, run);
  const SweptQuantity swept = swept_quantity(run);
  for (const std::string& line : failures(swept, run.sweep)) expect_one_line(line);
  for (const std::string& line : event_lines(run.scene, swept, run.sweep)) expect_one_line(line);
  const SweepTable table(run.scene, swept);
  for (const PoseResult& pose : run.sweep.poses) (void)table.row(pose);
}

void verify(const Run& run, const Source& source) {
  const Hdf5Reader reader(source.file, source.by);
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

/// Charts are made and not handed to gnuplot.
void draw([[maybe_unused]] const Run& run, [[maybe_unused]] std::uint64_t turn) {
#ifdef CONDYLE_PICTURES
  (void)run_plots(run);
  const std::vector<PoseResult>& poses = run.sweep.poses;
  const auto shown = std::find_if(poses.begin(), poses.end(), has_place);
  if (shown == poses.end()) return;
  const View view = std::array{View::kAnterior, View::kMedial, View::kPlateau}[turn / 16 % 3];
  const SurfaceColors colors = std::array{SurfaceColors::kPlain, SurfaceColors::kGap,
                                          SurfaceColors::kPressure}[turn / 48 % 3];
  (void)draw_knee(run, view, static_cast<std::size_t>(shown - poses.begin()),
                  {.width = 320, .height = 240, .colors = colors, .hertz = turn / 144 % 2 == 0});
#endif
}

/// What shows numbers, always; what takes a hundred times as long (a page has its run verified), by a hash of the bytes.
void show(const Run& run, const Source& source, std::uint64_t turn) {
  taken([&] { summarise(run); });
  taken([&] { export_numbers(run); });
  if (turn % 8 == 4)
    taken([&] { (void)report_page(run, "run.h5", {.pictures = false, .on_part = {}}); });
  if (turn % 16 == 0) taken([&] { verify(run, source); });
  if (turn % 16 == 8) taken([&] { export_shapes(run); });
  if (turn % 16 == 2) taken([&] { draw(run, turn); });
}

void show(const StudyView& study, const Source&, std::uint64_t) {
#ifdef CONDYLE_PICTURES
  (void)study_plots(study);
#endif
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
  const Source source{file_of(text), ReadBy::kProcessOfItsOwn};
  const std::uint64_t turn = hash_bytes(text);
  taken([&] {
    is_study_file(source.file) ? show(read_study_file(source.file), source, turn)
                               : show(read_run(source.file), source, turn);
  });
}

/// HDF5 has written the file itself, so what goes wrong goes wrong behind it.
void open_altered_run(Bytes bytes) {
  Choices choices(bytes);
  const Source source{file_of(altered_run(choices)), ReadBy::kThisProcess};
  const std::uint64_t turn = hash_bytes(text_of(bytes));
  if (!taken([&] { show(read_run(source.file, source.by), source, turn); }))
    taken([&] { show(read_study_file(source.file, source.by), source, turn); });
}

}  // namespace condyle::fuzz
