#pragma once

/// A study as Python asks for it: made ready, computed by threads, written, and opened.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "condyle/on_progress.h"
#include "condyle/results/study_columns.h"
#include "condyle/scene/study_with_scenes.h"

namespace condyle::python {

struct StudyToCompute {
  ReadStudy read;
  std::filesystem::path output;  ///< empty: a temporary file
  int threads = 0;               ///< 0: as many as there are cores
  bool resume = false;           ///< from the chunks that an earlier run left beside the output
};

/// Throws InputError. Ctrl-C, and what `progress` (samples) throws, end it: chunks that are done stay beside the output.
/// The caller has the interpreter's lock, which is released but while the file is written: HDF5 is not for several threads.
[[nodiscard]] std::shared_ptr<StudyColumns> compute_study(StudyToCompute asked,
                                                          const OnProgress& progress);

}  // namespace condyle::python
