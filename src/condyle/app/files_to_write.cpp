#include "condyle/app/files_to_write.h"

#include "condyle/input_error.h"
#include "condyle/results/output_file.h"

namespace condyle {

namespace fs = std::filesystem;

void check_files_to_write(const std::vector<FileToWrite>& files) {
  const auto place = [](const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); };
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      if (place(files[i].path) == place(files[k].path))
        throw InputError(files[i].path.string() +
                         ": is to be written twice, expected a file for each");
    if (files[i].ending.empty())
      check_output_file(files[i].path);
    else
      check_output_file(files[i].path, files[i].ending);
  }
}

std::vector<FileToWrite> given_files(std::vector<FileToWrite> files) {
  std::erase_if(files, [](const FileToWrite& file) { return file.path.empty(); });
  return files;
}

}  // namespace condyle
