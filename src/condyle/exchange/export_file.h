#pragma once

/// A file that is ready to be written, under its name in the folder that was asked for.

#include <filesystem>
#include <string>

namespace condyle {

struct ExportFile {
  std::filesystem::path path;
  std::string bytes;
};

}  // namespace condyle
