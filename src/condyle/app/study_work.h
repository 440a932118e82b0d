#pragma once

/// A study that is being computed by one process of a team.

#include <filesystem>
#include <memory>

#include "condyle/app/study_options.h"
#include "condyle/app/study_team.h"
#include "condyle/app/summary.h"
#include "condyle/results/study_journal.h"
#include "condyle/start_threads.h"
#include "condyle/study/study_worker.h"

namespace condyle {

struct StudyWork {
  const StudyCommand& command;
  const StudyTeam& team;
  CommandClock clock = {};
  StudyPlan plan = {};
  std::shared_ptr<const StudyModels> models = {};

  [[nodiscard]] const Talk& talk() const { return command.talk; }
  [[nodiscard]] std::filesystem::path folder() const {
    return StudyJournals::folder(command.output);
  }
  [[nodiscard]] int threads() const { return thread_count(command.threads); }
};

}  // namespace condyle
