#include "condyle/pictures/picture_folder.h"

#include "condyle/file_ending.h"
#include "condyle/input_error.h"

namespace condyle {

std::filesystem::path make_picture_folder(const std::string& folder) {
  std::filesystem::path path(folder);
  if (!path.has_filename()) path = path.parent_path();
  if (std::filesystem::is_directory(path)) return path;
  const std::filesystem::path parent = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code error;
  if (std::filesystem::exists(path)) throw InputError(folder + ": expected a folder");
  for (const char* ending : {".png", ".svg", ".pdf"})
    if (file_ending(path) == ending)
      throw InputError(folder + ": is the name of one file, expected a folder for several");
  if (!std::filesystem::is_directory(parent))
    throw InputError(folder + ": the folder " + parent.string() + " does not exist");
  std::filesystem::create_directory(path, error);
  if (error) throw InputError(folder + ": cannot make this folder: " + error.message());
  return path;
}

}  // namespace condyle
