#pragma once

/// The result of a study (format "condyle study 1", docs/results.md): /samples, /outputs, /bands,
/// /indices, /failures, written from chunks in the order of samples with no more than one output in
/// memory, and what pictures and pages read of it.

#include <filesystem>
#include <string>
#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/on_progress.h"
#include "condyle/results/read_by.h"
#include "condyle/results/study_journal.h"
#include "condyle/scene/swept_quantity.h"
#include "condyle/study/study_plan.h"
#include "condyle/study/study_summary.h"

namespace condyle {

/// Bytes that the result and the journals of a study take on disk.
[[nodiscard]] std::uint64_t study_bytes(const StudyPlan& plan);

/// Throws InputError ("needs 12.3 GB, the disk has 4.5 GB") where there is no room for what is not in
/// the folder of journals yet.
void expect_room(const std::filesystem::path& result, const StudyPlan& plan);

/// How a result came to be: all that may differ between runs of a study (/provenance).
struct StudyProvenance {
  double seconds = 0;  ///< of the computation
  int threads = 1, processes = 1;
};

/// Merges the chunks, which must be complete, reduces them, and writes the file: whole or not at all.
/// `nominal` as by knees. The same bytes for the same chunks, but for /provenance. Of several knees the
/// summary of all pools their samples; Sobol's indices are told of each knee by itself.
StudySummary write_study(const std::filesystem::path& path,
                         const StudyPlan& plan,
                         const StudyJournals& journals,
                         const std::vector<const SweepResult*>& nominal,
                         const StudyProvenance& provenance = {},
                         const OnProgress& on_output = {});

/// Whether that file is the whole result of this study.
[[nodiscard]] bool holds_study(const std::filesystem::path& path, const StudyPlan& plan);

/// What there is to show of a study: all but the samples.
struct StudyView {
  std::string title, text;  ///< of the study file
  std::string program, created;
  std::vector<std::string> knees;   ///< names
  std::vector<std::string> scenes;  ///< texts
  std::string design;               ///< "saltelli"
  std::uint64_t seed = 0;
  long samples = 0, points = 0;  ///< of all knees; of each
  SweptQuantity swept;
  std::vector<double> values;  ///< of the sweep, in the unit of result files
  struct Parameter {
    std::string name, units;
    bool logarithmic = false;
    std::string spread;  ///< in words: "normal, sd 0.02", of factors "log-uniform, 0.8 to 1.2"
    double typical = 0;  ///< sd of θ over the samples
  };
  std::vector<Parameter> parameters;
  struct Output {
    std::string name, units;
  };
  std::vector<Output> outputs;
  StudySummary all;
  std::vector<StudySummary> by_knee;  ///< of a population; else empty
};

/// False for a file that is missing or holds something else. Throws DamagedFile for one so damaged that it is not
/// known (hdf5_process.h): whoever asks would wait for that as long again.
[[nodiscard]] bool is_study_file(const std::filesystem::path& path);
/// Throws InputError for a file that is missing or is no study.
[[nodiscard]] StudyView read_study_file(const std::filesystem::path& path,
                                        ReadBy by = ReadBy::kProcessOfItsOwn);

}  // namespace condyle
