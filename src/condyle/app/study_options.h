#pragma once

/// What `condyle study` is asked for on its command line.

#include <cstdint>
#include <optional>
#include <string>

#include "condyle/app/talk.h"
#include "condyle/results/study_folder.h"

namespace condyle {

struct StudyCommand {
  Talk talk;
  std::string study, output;
  std::string bands, indices, table;  ///< CSV files; empty: not asked for
  std::optional<std::uint64_t> seed;
  std::optional<long> samples;
  int threads = 0;  ///< of each process; 0: as many as there are cores
  StudyPart part;
  bool merge = false, resume = false;
};

}  // namespace condyle
