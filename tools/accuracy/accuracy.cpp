/// Measures what an answer costs and how wrong it is. Arguments: the folder to write into, the
/// folder of the project, and the studies to run, all where none is named.
///
/// Writes docs/accuracy.md with the figures of this run into the folder. Ends with 2 where
/// something that was to hold does not.

#include <fmt/os.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "accuracy/clock.h"
#include "accuracy/page.h"
#include "accuracy/parts.h"
#include "accuracy/study.h"

namespace condyle::accuracy {
namespace {

struct Chapter {
  const char* name;
  Study (*study)(const Setting&);
};

constexpr Chapter kChapters[] = {{"surfaces", study_surfaces}, {"smoothing", study_smoothing},
                                 {"solver", study_solvers},    {"way", study_whole_way},
                                 {"parts", study_parts},       {"growth", study_growth},
                                 {"hard", study_hard_cases}};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  return {std::istreambuf_iterator<char>(stream), {}};
}

int run(const Setting& setting, const std::vector<std::string>& wanted) {
  const std::string old = (setting.root / "docs/accuracy.md").string();
  std::string page = with_block(text_of(old), "machine", machine());
  std::vector<std::string> broken;
  for (const Chapter& chapter : kChapters) {
    if (!wanted.empty() && std::count(wanted.begin(), wanted.end(), chapter.name) == 0) continue;
    fmt::print(stderr, "{} ...", chapter.name);
    Study study;
    const double time = least_microseconds(1, [&] { study = chapter.study(setting); });
    fmt::print(stderr, " {:.0f} s\n", time / 1e6);
    std::string in_short;
    for (const std::string& line : study.in_short) in_short += "- " + line + "\n";
    page = with_block(page, chapter.name, "\n" + study.page + "\n");
    page = with_block(page, std::string(chapter.name) + " in short", in_short);
    fmt::output_file((setting.folder / "accuracy.md").string()).print("{}", page);
    broken.insert(broken.end(), study.broken.begin(), study.broken.end());
  }
  for (const std::string& what : broken) fmt::print(stderr, "does not hold: {}\n", what);
  return broken.empty() ? 0 : 2;
}

}  // namespace
}  // namespace condyle::accuracy

int main(int argc, char** argv) {
  using namespace condyle::accuracy;
  if (argc < 3) {
    fmt::print(stderr, "usage: condyle_accuracy FOLDER PROJECT [STUDY...]\n");
    return 1;
  }
  try {
    const Setting setting{argv[1], argv[2]};
    const std::vector<std::string> wanted(argv + 3, argv + argc);
    if (argc == 4 && wanted[0].starts_with(kPartPrefix))
      return measure_part(wanted[0].substr(kPartPrefix.size()));
    std::filesystem::create_directories(setting.folder);
    return run(setting, wanted);
  } catch (const std::exception& error) {
    fmt::print(stderr, "condyle_accuracy: {}\n", error.what());
    return 1;
  }
}
