#include "condyle/app/run_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace condyle {

std::vector<std::string> run_names(const std::vector<std::string>& files) {
  std::vector<std::string> names;
  for (auto file = files.begin(); file != files.end(); ++file) {
    const std::filesystem::path path(*file);
    const auto alike = [&](const std::string& other) {
      return std::filesystem::path(other).stem() == path.stem();
    };
    const bool unique = std::count_if(files.begin(), files.end(), alike) == 1;
    const auto before = std::count(files.begin(), file, *file);
    std::string name = unique ? path.stem().string() : *file;
    if (before > 0) name += fmt::format(" ({})", before + 1);
    names.push_back(name);
  }
  return names;
}

}  // namespace condyle
