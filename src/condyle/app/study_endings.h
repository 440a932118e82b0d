#pragma once

/// How a study ends: what is written, what is said, and the exit code.

#include "condyle/app/study_work.h"

namespace condyle {

/// Whether the folder holds chunks of a run that did not end.
[[nodiscard]] bool holds_chunks(const std::filesystem::path& folder);

/// --resume of a study that is complete.
[[nodiscard]] bool is_complete(const StudyWork& work);
/// Of one that is complete: throws InputError for --table. Samples are told from chunks, which are gone.
void expect_no_table(const StudyWork& work);
int complete_already(const StudyWork& work);

int stopped_study(const StudyWork& work, const StudyJournals& journals);
int finished_part(const StudyWork& work, const StudyJournals& journals);
/// Merges, writes the result and the tables, and removes the journals.
int finished_study(const StudyWork& work, StudyJournals& journals);

}  // namespace condyle
