#pragma once

/// What `condyle study` does, for one process with threads and for the ranks of a network alike.

#include "condyle/app/study_options.h"
#include "condyle/app/study_team.h"

namespace condyle {

/// The command `study` of a team, whose processes compute on one thread each unless told otherwise;
/// `setup_study` (commands.h) is that of a process of its own.
void setup_team_study(CLI::App& program, int& status, const StudyTeam& team);

/// Arguments and options of `study` but those of Talk; each --option checks itself.
void add_study_options(CLI::App& command, StudyCommand& options);

/// Returns the exit code: 0, or 2 where it was stopped or a nominal sweep fails. Throws InputError; on
/// a team the process that throws must end the others.
int run_study(const StudyCommand& command, const StudyTeam& team = {});

}  // namespace condyle
