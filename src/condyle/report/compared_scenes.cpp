#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "condyle/input_error.h"
#include "condyle/report/compared_runs_page.h"
#include "condyle/report/html.h"
#include "condyle/report/scene_differences.h"
#include "condyle/report/text_difference.h"

namespace condyle {
namespace {

constexpr std::size_t kMostRows = 150;

std::string scene_table(const RunComparison& comparison,
                        const std::vector<SceneDifference>& differences) {
  HtmlTable table{"In brackets the change from the first run", {"of", "what"}, {}, {0, 1}};
  for (const ComparedRun& of : comparison.runs) table.columns.push_back(of.name);
  for (const SceneDifference& difference : differences) {
    if (table.rows.size() == kMostRows) break;
    std::vector<std::string>& row = table.rows.emplace_back();
    row = {difference.where.empty() ? "scene" : difference.where, difference.what};
    for (std::size_t r = 0; r < comparison.runs.size(); ++r)
      row.push_back(value_beside_first(difference, r));
  }
  std::string text = html(table);
  if (differences.size() > kMostRows)
    text += fmt::format("<p>And {} differences more, in the texts below.</p>\n",
                        differences.size() - kMostRows);
  return text;
}

/// First digits of the checksums of all files of that name, wherever they stand.
std::string digests_of(const Run& run, const std::string& name) {
  constexpr std::size_t kDigits = 12;
  std::string digests;
  for (const InputFile& input : run.inputs)
    if (std::filesystem::path(input.file).filename() == name)
      digests += (digests.empty() ? "" : ", ") + input.sha256.substr(0, kDigits);
  return digests.empty() ? "-" : digests;
}

/// Meshes that not all runs have been computed from, byte by byte.
std::string input_table(const RunComparison& comparison) {
  HtmlTable table{
      "Meshes that are not the same (first digits of their SHA-256)", {"file"}, {}, {0}};
  for (const ComparedRun& of : comparison.runs) table.columns.push_back(of.name);
  std::vector<std::string> names;
  for (const ComparedRun& of : comparison.runs)
    for (const InputFile& input : of.run->inputs)
      names.push_back(std::filesystem::path(input.file).filename().string());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  for (const std::string& name : names) {
    std::vector<std::string> row = {name};
    for (const ComparedRun& of : comparison.runs) row.push_back(digests_of(*of.run, name));
    const bool same = std::all_of(row.begin() + 1, row.end(),
                                  [&](const auto& digests) { return digests == row[1]; });
    if (!same) table.rows.push_back(row);
  }
  return table.rows.empty() ? "" : html(table);
}

std::string difference_text(const std::string& first, const std::string& second) {
  const auto lines = text_difference(first, second);
  if (!lines) return "<p>The texts differ in too many lines to show.</p>\n";
  std::string text = "<pre class=\"difference\">";
  for (const DifferenceLine& line : *lines) {
    switch (line.kind) {
      case DifferenceLine::Kind::kSame:
        text += "  " + escaped(line.text) + "\n";
        break;
      case DifferenceLine::Kind::kOnlyFirst:
        text += "<del>- " + escaped(line.text) + "</del>\n";
        break;
      case DifferenceLine::Kind::kOnlySecond:
        text += "<ins>+ " + escaped(line.text) + "</ins>\n";
        break;
      case DifferenceLine::Kind::kLeftOut:
        text += "  ...\n";
        break;
    }
  }
  return text + "</pre>\n";
}

std::string texts_below(const RunComparison& comparison) {
  const ComparedRun& first = comparison.runs.front();
  std::string body;
  for (std::size_t r = 1; r < comparison.runs.size(); ++r) {
    const ComparedRun& other = comparison.runs[r];
    if (other.run->scene.text != first.run->scene.text)
      body += details(fmt::format("Lines of {} (-) and {} (+)", first.name, other.name),
                      difference_text(first.run->scene.text, other.run->scene.text));
  }
  return body;
}

}  // namespace

std::string compared_scenes_section(const RunComparison& comparison) {
  std::vector<std::string> texts;
  for (const ComparedRun& of : comparison.runs) texts.push_back(of.run->scene.text);
  const std::string below = texts_below(comparison), inputs = input_table(comparison);
  std::string body;
  if (below.empty()) {
    body = "<p>All scenes are the same, letter by letter.</p>\n";
  } else {
    try {
      const std::vector<SceneDifference> differences = scene_differences(texts);
      body = differences.empty() ? "<p>The scenes differ in comments, order and blanks alone.</p>\n"
                                 : scene_table(comparison, differences);
    } catch (const InputError& error) {
      body = fmt::format("<p>A scene's text cannot be read: {}</p>\n", escaped(error.what()));
    }
  }
  return section("scenes", "What differs in the scenes", body + inputs + below);
}

}  // namespace condyle
