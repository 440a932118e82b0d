#include "condyle/app/default_template.h"

#include <system_error>
#include <vector>

#include "condyle/input_error.h"

namespace condyle {

std::filesystem::path default_template() {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder : {program.parent_path() / "share" / "condyle", program.parent_path(),
                                 fs::path(CONDYLE_TEMPLATES)}) {
    fs::path scene = folder / "data" / "phantom" / "knee.toml";
    if (fs::is_regular_file(scene, error) &&
        fs::is_regular_file(folder / "meshes" / "femur.stl", error))
      return scene;
  }
  throw InputError(
      "the phantom that ships as a template is not beside the program, expected --template SCENE");
}

}  // namespace condyle
