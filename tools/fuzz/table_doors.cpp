/// Tables and models of other programs: measurements, a robot's tables, OpenSim.

#include <stdexcept>

#include "condyle/calibration/measurement_table.h"
#include "condyle/exchange/laxity_tables.h"
#include "condyle/exchange/osim_scene.h"
#include "condyle/scene_file/read_scene.h"
#include "fuzz/door_list.h"
#include "fuzz/memory_file.h"
#include "fuzz/refusal.h"

namespace condyle::fuzz {

void open_measurements(Bytes bytes) {
  static Scene scene =
      read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/phantom/calibrate.toml");
  const MemoryFile file(bytes);
  scene.calibration->measurements = file.path();
  taken([&] {
    const MeasurementTable table = read_measurements(scene);
    for (const Measurement& row : table.rows) {
      expect_one_line(name_of(row, table, scene));
      expect_one_line(quantity_of(row, scene));
      if (!(row.sd > 0)) throw std::logic_error("a deviation that is not positive is accepted");
    }
  });
}

void open_laxity_table(Bytes bytes) {
  static const std::string kinetics = "Laxity_AP1_kinetics_in_JCS_experiment.csv",
                           kinematics = "Laxity_AP1_kinematics_in_JCS_experiment.csv";
  // The two tables follow each other, parted by a line of its own.
  const std::string text = text_of(bytes);
  const std::size_t parted = text.find("\n--\n");
  write_scratch(kinetics, text.substr(0, parted));
  write_scratch(kinematics, parted == std::string::npos ? text : text.substr(parted + 4));
  LaxityTableOptions options;
  options.sd_length = options.sd_angle = 0.5;
  options.held = static_cast<double>(text.size() % 3);
  options.mean = text.size() % 2 == 0;
  taken([&] {
    const LaxityTable table = laxity_table({scratch() / kinematics, scratch() / kinetics}, options);
    for (const std::string& note : table.notes) expect_one_line(note);
  });
}

void open_osim(Bytes bytes) {
  const MemoryFile file(bytes);
  taken([&] {
    const OsimModel model = read_osim(file.path());
    const OsimKnee knee = find_knee(model, "model.osim");
    const OsimScene scene =
        osim_scene(model, knee, scratch() / "model.osim", scratch() / "out.toml");
    for (const std::string& note : scene.notes) expect_one_line(note);
    (void)parse_scene(scene.text, scratch() / "out.toml");
  });
}

}  // namespace condyle::fuzz
