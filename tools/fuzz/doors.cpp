#include "fuzz/doors.h"

#include <algorithm>
#include <stdexcept>

#include "fuzz/door_list.h"

namespace condyle::fuzz {

const std::vector<Door>& doors() {
  constexpr std::size_t kText = 4096, kChoices = 512, kFile = 1 << 18;
  static const std::vector<Door> all = {
      {"scene", open_scene, 8192},
      {"made_scene", open_made_scene, kChoices},
      {"study", open_study, kText},
      {"stl", open_stl, kText},
      {"ply", open_ply, kText},
      {"obj", open_obj, kText},
      {"off", open_off, kText},
      {"measurements", open_measurements, kText},
      {"laxity_table", open_laxity_table, kText},
      {"osim", open_osim, kText},
      {"sweep_journal", open_sweep_journal, kText},
      {"calibration_journal", open_calibration_journal, kText},
      {"piece_journal", open_piece_journal, kText},
      {"motion_journal", open_motion_journal, kText},
      {"study_chunks", open_study_chunks, kText},
      {"run", open_run, kFile},
      {"altered_run", open_altered_run, 256},
      {"command_line", open_command_line, 512},
      {"sweep", open_sweep, kChoices},
  };
  return all;
}

const Door& door(const std::string& name) {
  const auto found = std::ranges::find(doors(), name, &Door::name);
  if (found == doors().end()) throw std::out_of_range("no door is called " + name);
  return *found;
}

}  // namespace condyle::fuzz
