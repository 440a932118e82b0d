/// Measures what an answer costs and how wrong it is. Arguments: the folder to write into, the
/// folder of the project.

#include <fmt/os.h>

#include <exception>
#include <filesystem>

#include "accuracy/study.h"

int main(int argc, char** argv) {
  using namespace condyle::accuracy;
  if (argc != 3) {
    fmt::print(stderr, "usage: condyle_accuracy FOLDER PROJECT\n");
    return 1;
  }
  try {
    const std::filesystem::path folder = argv[1], root = argv[2];
    std::filesystem::create_directories(folder);
    const std::string page = study_surfaces(folder) + study_solvers(folder) +
                             study_whole_way(folder, root) + study_costs(folder) +
                             study_hard_cases(folder, root);
    fmt::output_file((folder / "accuracy.md").string()).print("{}", page);
    fmt::print("{}", page);
  } catch (const std::exception& error) {
    fmt::print(stderr, "condyle_accuracy: {}\n", error.what());
    return 1;
  }
}
