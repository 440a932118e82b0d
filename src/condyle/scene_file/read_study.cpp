#include "condyle/scene_file/read_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/scene_file/read_sections.h"
#include "condyle/scene_file/read_study_parts.h"

namespace condyle {
namespace {

constexpr double kMostPoints = 9007199254740992;  // 2^53

const Choices<DesignKind>& designs() {
  static const Choices<DesignKind> kinds = {{"monte-carlo", DesignKind::kMonteCarlo},
                                            {"latin-hypercube", DesignKind::kLatinHypercube},
                                            {"sobol", DesignKind::kSobol},
                                            {"saltelli", DesignKind::kSaltelli},
                                            {"grid", DesignKind::kGrid}};
  return kinds;
}

/// A word of the list, or the path of a table.
void read_design(const Section& root, StudyDescription& study) {
  std::vector<std::string> words;
  for (const auto& [word, unused] : designs()) words.push_back(word);
  const std::string expected = listed(words) + ", or the path of a table (CSV)";
  const std::string word = root.text("design", expected);
  const auto known = std::find(words.begin(), words.end(), word);
  if (known != words.end()) {
    study.design = designs()[static_cast<std::size_t>(known - words.begin())].second;
    return;
  }
  const std::filesystem::path table = root.source().folder / word;
  std::error_code error;
  if (!std::filesystem::is_regular_file(table, error)) {
    const std::string meant = nearest(word, words);
    const bool is_there = std::filesystem::exists(table, error);
    root.fail("design",
              meant.empty() || is_there
                  ? fmt::format("{} ({} {})", expected,
                                is_there ? "no table is" : "there is no file", table.string())
                  : fmt::format("{}; did you mean \"{}\"?", expected, meant));
  }
  study.design = DesignKind::kTable;
  study.table = table;
}

double whole_number(const Section& root, const std::string& key, double least, double most) {
  std::string expected = fmt::format("a whole number >= {:.0f}", least);
  if (most < kMostPoints)
    expected = fmt::format("a whole number from {:.0f} to {:.0f}", least, most);
  const double number = root.number(key, expected);
  if (number > kMostPoints) expected += " and <= 2^53";
  if (number != std::floor(number) || number < least || number > most) root.fail(key, expected);
  return number;
}

/// A key that only some designs have.
bool has_of_design(const Section& root, const std::string& key, bool fits, const char* where) {
  if (!root.has(key)) return false;
  if (!fits) root.fail(key, where);
  return true;
}

void read_samples(const Section& root, StudyDescription& study) {
  const bool grid = study.design == DesignKind::kGrid, table = study.design == DesignKind::kTable;
  const bool given =
      has_of_design(root, "samples", !grid, "levels in its place: a grid has levels^d points");
  if (given || (!grid && !table))
    study.samples = static_cast<long>(whole_number(root, "samples", 1, kMostPoints));
  constexpr double kMostLevels = 1e6;
  if (has_of_design(root, "levels", grid, "design = \"grid\" beside it"))
    study.levels = static_cast<int>(whole_number(root, "levels", 2, kMostLevels));
  static const Choices<bool> contents = {{"changes", false}, {"values", true}};
  if (has_of_design(root, "table", table, "the path of a table as design beside it"))
    study.table_holds_values = root.choice("table", contents);
  if (root.has("seed"))
    study.seed = static_cast<std::uint64_t>(whole_number(root, "seed", 0, kMostPoints));
}

void read_outputs(const Section& root, StudyDescription& study) {
  static const Choices<bool> precisions = {{"float64", false}, {"float32", true}};
  if (root.has("precision")) study.single_precision = root.choice("precision", precisions);
  if (!root.has("outputs")) return;
  const std::string expected = "words [\"joint\", \"contact.force\", \"aACL.force\", ...]";
  const Value& list = root.value("outputs", expected);
  if (list.type != Value::Type::kArray || list.items.empty()) root.fail("outputs", expected);
  study.outputs_line = list.line;
  for (const Value& item : list.items) {
    if (item.type != Value::Type::kText || item.text.empty()) root.fail("outputs", item, expected);
    if (std::find(study.outputs.begin(), study.outputs.end(), item.text) != study.outputs.end())
      root.fail("outputs", item, "each word once");
    study.outputs.push_back(item.text);
  }
}

/// How many coordinates a point of the design has.
std::size_t dimensions(const ReadStudy& read) {
  std::size_t count = read.study.roughness ? 1 : 0;
  for (const VariedNumber& varied : read.varied.front())
    count += (varied.number.together ? 1 : varied.number.of.size()) *
             (varied.number.what == ParameterKind::kInsertion ? 3 : 1);
  return count;
}

void expect_countable(const Section& root, const ReadStudy& read) {
  const auto d = static_cast<double>(dimensions(read));
  const StudyDescription& study = read.study;
  if (study.design == DesignKind::kGrid && std::pow(study.levels, d) > kMostPoints)
    root.fail(root.has("levels") ? "levels" : "design",
              fmt::format("a grid of at most 2^53 points: {}^{:.0f} = {:.3g} are more",
                          study.levels, d, std::pow(study.levels, d)));
  const double knees = static_cast<double>(read.scenes.size());
  const double blocks = study.design == DesignKind::kSaltelli ? d + 2 : 1;
  if (static_cast<double>(study.samples) * blocks * knees > kMostPoints)
    root.fail("samples", "at most 2^53 of all blocks and knees");
}

}  // namespace

ReadStudy read_study(const std::filesystem::path& file) {
  return parse_study(text_of(file, "a study (TOML)"), file);
}

ReadStudy parse_study(std::string text, const std::filesystem::path& file) {
  ReadStudy read;
  StudyDescription& study = read.study;
  study.text = std::move(text);
  study.file = file;
  const Source source{file.string(), file.parent_path()};
  const Value document = parse_document(study.text, source.file);
  const Section root(document, source, "");
  if (document.find("body") != nullptr)
    root.fail_with("is a scene, expected a study, which names scenes as its specimens");
  study.title = root.has("title") ? root.text("title", "a title") : file.stem().string();
  read_design(root, study);
  read_samples(root, study);
  read_outputs(root, study);
  read_specimens(root, read);
  read_varied_numbers(root, read);
  root.finish();
  expect_countable(root, read);
  return read;
}

}  // namespace condyle
