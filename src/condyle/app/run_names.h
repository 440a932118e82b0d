#pragma once

/// Names of several runs for legends and tables.

#include <string>
#include <vector>

namespace condyle {

/// Those of the files, with their folders where files have the same name, and with a number where one
/// file is named twice.
[[nodiscard]] std::vector<std::string> run_names(const std::vector<std::string>& files);

}  // namespace condyle
