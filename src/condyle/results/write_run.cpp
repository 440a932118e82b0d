#include <fmt/format.h>

#include <array>
#include <ctime>

#include "condyle/results/calibration_group.h"
#include "condyle/results/comparison_groups.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/results/output_file.h"
#include "condyle/results/patch_group.h"
#include "condyle/results/points_dataset.h"
#include "condyle/results/run_columns.h"
#include "condyle/results/run_layout.h"
#include "condyle/results/run_view.h"
#include "condyle/results/sensitivity_group.h"
#include "condyle/results/simulation_group.h"
#include "condyle/results/sweep_group.h"
#include "condyle/results/uncertainty_group.h"
#include "condyle/results/wrap_group.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/version.h"

namespace condyle {
namespace {

using Poses = std::vector<PoseResult>;

std::string now() {
  const std::time_t time = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

void write_head(const Hdf5Group& root, const Scene& scene) {
  root.write_attribute("title", scene.title);
  root.write_attribute("format", kRunFormat);
  root.write_attribute("program", "condyle " CONDYLE_VERSION);
  root.write_attribute("created", now());
  root.write_attribute("scene", scene.text);
  root.write_attribute("scene_file", scene.file.string());
}

void write_events(const Hdf5Group& group, const Run& run, const Unit& unit) {
  const std::vector<Event>& events = run.sweep.events;
  std::vector<double> values;
  std::vector<int> kinds, contacts, ligaments, wraps;
  for (const Event& event : events) {
    values.push_back(event.value / unit.factor);
    kinds.push_back(static_cast<int>(event.kind));
    contacts.push_back(event.contact);
    ligaments.push_back(event.ligament);
    wraps.push_back(
        event.ligament < 0
            ? -1
            : wrap_on_path(run.scene, run.scene.ligaments[static_cast<std::size_t>(event.ligament)],
                           event.wrap));
  }
  const Shape n = {events.size()};
  group.write("value", values, n, unit.name);
  group.write("kind", kinds, n, "1");
  group.write("contact", contacts, n, "1");
  std::vector<std::string> meanings, names;
  for (int i = 0; i < kEventKindCount; ++i) meanings.emplace_back(name(static_cast<EventKind>(i)));
  for (const ContactDescription& contact : run.scene.contacts) names.push_back(contact.name);
  group.write_attribute("kind", "meaning", meanings);
  group.write_attribute("contact", "meaning", names);
  if (run.scene.wraps.empty()) return;
  group.write("ligament", ligaments, n, "1");
  group.write("wrap", wraps, n, "1");
  std::vector<std::string> ligament_names, wrap_names;
  for (const LigamentDescription& ligament : run.scene.ligaments)
    ligament_names.push_back(ligament.name);
  for (const WrapDescription& wrap : run.scene.wraps) wrap_names.push_back(wrap.name);
  group.write_attribute("ligament", "meaning", ligament_names);
  group.write_attribute("wrap", "meaning", wrap_names);
}

void write_body(const Hdf5Group& group, const TriangleMesh& mesh) {
  group.write("vertices", coordinates(mesh.vertices), {mesh.vertices.size(), 3}, "mm");
  std::vector<int> corners;
  corners.reserve(3 * mesh.triangles.size());
  for (const std::array<int, 3>& triangle : mesh.triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  group.write("triangles", corners, {mesh.triangles.size(), 3}, "1");
}

void write_inputs(const Hdf5Group& root, const std::vector<InputFile>& inputs) {
  if (inputs.empty()) return;
  std::vector<std::string> files, digests;
  for (const InputFile& input : inputs) {
    files.push_back(input.file);
    digests.push_back(input.sha256);
  }
  const Hdf5Group group = root.create("inputs");
  group.write("file", files);
  group.write("sha256", digests);
}

/// Of /sweep what is not of single poses.
void write_beside_poses(const Hdf5Group& sweep, const Run& run) {
  if (run.sensitivities) write_sensitivities(sweep.create("sensitivities"), *run.sensitivities);
  if (run.uncertainty) write_uncertainty(sweep.create("uncertainty"), *run.uncertainty);
}

enum class WithSweep { kNo, kYes };

void write_all(const Hdf5Group& root, const Run& run, WithSweep with_sweep) {
  write_head(root, run.scene);
  write_wraps(root, run.scene);
  if (!run.sweep.poses.empty()) {
    const Unit unit = swept_quantity(run).unit;
    if (with_sweep == WithSweep::kYes) {
      const Hdf5Group sweep = root.create("sweep");
      write_sweep(sweep, run.scene, unit, run.sweep.poses);
      write_beside_poses(sweep, run);
    }
    write_events(root.create("events"), run, unit);
  }
  const Hdf5Group patches = root.create("patches");
  for (const RunPatch& patch : run.patches)
    write_patch(patches.create(patch.surface), patch, run.scene);
  write_inputs(root, run.inputs);
  if (!run.start.empty()) root.create("fit").write("start", run.start);
  const Hdf5Group bodies = root.create("bodies");
  for (const BodyMesh& body : run.bodies) write_body(bodies.create(body.name), body.mesh);
  if (run.comparison()) write_comparison(root, run.scene, *run.comparison());
  if (run.simulation()) write_simulation(root.create("simulate"), run.scene, *run.simulation());
  if (run.laxity()) write_laxity(root.create("laxity"), run.scene, *run.laxity());
  if (run.calibration()) write_calibration(root, run.scene, *run.calibration());
}

}  // namespace

ColumnTree columns_of(const Run& run) {
  ColumnTree columns;
  write_all(Hdf5Group(columns, "/"), run, WithSweep::kYes);
  return columns;
}

ColumnTree columns_beside_sweep(const Run& run) {
  ColumnTree columns;
  write_all(Hdf5Group(columns, "/"), run, WithSweep::kNo);
  return columns;
}

void add_columns(
    ColumnTree& sweep, SweepPart part, const Scene& scene, const Unit& unit, const Poses& poses) {
  write_sweep_part(Hdf5Group(sweep, "/sweep/"), part, scene, unit, poses);
}

void add_columns_beside_poses(ColumnTree& sweep, const Run& run) {
  write_beside_poses(Hdf5Group(sweep, "/sweep/"), run);
}

void write_run(const std::filesystem::path& path, const Run& run) {
  check_output_file(path);
  const Hdf5Builder builder(path.string());
  write_all(builder.root(), run, WithSweep::kYes);
  write_output_file(path, builder.bytes());
}

}  // namespace condyle
