#pragma once

/// What `condyle study` reads, and what it may write.

#include <filesystem>
#include <vector>

#include "condyle/app/study_options.h"
#include "condyle/study/study_plan.h"

namespace condyle {

/// Reads and checks all that the command line names, and fits the surfaces of the knees aloud. Throws
/// InputError, also where a file to write is one of those that are read, before anything long begins.
[[nodiscard]] StudyPlan ready_study(const StudyCommand& command);

/// What varies, how, and how much there is to compute, a line each.
[[nodiscard]] std::vector<std::string> plan_lines(const StudyPlan& plan);

}  // namespace condyle
