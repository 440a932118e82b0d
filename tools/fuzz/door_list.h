#pragma once

/// The doors one by one (doors.cpp has the table): each does with what it accepts what the program would.

#include "fuzz/door.h"

namespace condyle::fuzz {

void open_scene(Bytes text);          ///< TOML
void open_made_scene(Bytes choices);  ///< a scene of scene_grammar.h, solvable or nearly so
void open_study(Bytes text);          ///< TOML, beside a scene

void open_stl(Bytes file);
void open_ply(Bytes file);
void open_obj(Bytes file);
void open_off(Bytes file);

void open_measurements(Bytes file);  ///< CSV of [calibrate]
void open_laxity_table(Bytes file);  ///< CSV of a robot, `condyle import`
void open_osim(Bytes file);

void open_sweep_journal(Bytes file);
void open_calibration_journal(Bytes file);
void open_piece_journal(Bytes file);   ///< of laxity and compare
void open_motion_journal(Bytes file);  ///< of simulate
void open_study_chunks(Bytes file);

void open_run(Bytes file);             ///< HDF5, of any kind
void open_altered_run(Bytes choices);  ///< a whole result with some of its parts altered

void open_command_line(Bytes arguments);  ///< parted by line ends; nothing is computed
void open_sweep(Bytes choices);           ///< a scene of scene_grammar.h is swept

}  // namespace condyle::fuzz
