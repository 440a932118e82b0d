#pragma once

#include <string>
#include <vector>

namespace condyle::accuracy {

/// A program that was run to its end.
struct Process {
  bool good = false;     ///< it was found and ended with 0
  std::string output;    ///< what it said
  double seconds = 0;    ///< of the processor
  double megabytes = 0;  ///< most memory that it held (resident); 0 where the system does not tell
};

/// The first word of the command is a path.
[[nodiscard]] Process run_process(const std::vector<std::string>& command);

}  // namespace condyle::accuracy
