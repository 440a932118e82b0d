#pragma once

/// Plots as parts of a page.

#include <stdlib.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

namespace condyle {

/// A folder that is gone with all it holds when the work is done.
class PassingFolder {
 public:
  PassingFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "condyle-report-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw std::filesystem::filesystem_error("no folder for pictures", name,
                                              std::error_code(errno, std::generic_category()));
    path_ = name;
  }
  ~PassingFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// An SVG file as a figure. Several share one page: `prefix` goes before its own names.
[[nodiscard]] std::string plot_figure(const std::filesystem::path& svg, const std::string& prefix);

}  // namespace condyle
