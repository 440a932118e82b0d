#include "condyle/report/compared_runs_json.h"

#include <nlohmann/json.hpp>

#include "condyle/input_error.h"
#include "condyle/report/compared_words.h"
#include "condyle/report/scene_differences.h"

namespace condyle {
namespace {

using ComparisonJson = nlohmann::ordered_json;

ComparisonJson runs_of(const RunComparison& comparison) {
  ComparisonJson rows = ComparisonJson::array();
  for (const ComparedRun& of : comparison.runs)
    rows.push_back({{"name", of.name},
                    {"file", of.file},
                    {"title", of.run->scene.title},
                    {"poses", of.run->sweep.poses.size()},
                    {"converged", of.run->sweep.count_converged()}});
  return rows;
}

ComparisonJson scenes_of(const RunComparison& comparison) {
  std::vector<std::string> texts;
  for (const ComparedRun& of : comparison.runs) texts.push_back(of.run->scene.text);
  ComparisonJson rows = ComparisonJson::array();
  try {
    for (const SceneDifference& difference : scene_differences(texts)) {
      ComparisonJson values = ComparisonJson::array();
      for (const auto& value : difference.values)
        values.push_back(value ? ComparisonJson(*value) : ComparisonJson());
      rows.push_back({{"of", difference.where}, {"what", difference.what}, {"values", values}});
    }
  } catch (const InputError&) {
    return {};  // a text that cannot be read: nothing is known
  }
  return rows;
}

ComparisonJson differences_of(const RunComparison& comparison) {
  ComparisonJson rows = ComparisonJson::array();
  for (const ComparedCurve& curve : comparison.curves) {
    for (std::size_t r = 1; r < comparison.runs.size(); ++r) {
      if (!curve.differences[r] || curve.differences[r]->count == 0) continue;
      const CurveDifference& d = *curve.differences[r];
      rows.push_back({{"run", comparison.runs[r].name},
                      {"what", without_units(curve.group)},
                      {"units", units_of(curve.group)},
                      {"of", curve.name},
                      {"largest", d.largest},
                      {"at", d.at},
                      {"rms", d.rms},
                      {"values", d.count},
                      {"interpolated", d.interpolated}});
    }
  }
  return rows;
}

}  // namespace

std::string json_compared_runs(const CommandSummary& summary, const RunComparison& comparison) {
  ComparisonJson json = {{"command", summary.command},
                         {"version", summary.version},
                         {"exit_code", summary.exit_code},
                         {"seconds", summary.seconds},
                         {"runs", runs_of(comparison)},
                         {"over", comparison.axis},
                         {"scene_differences", scenes_of(comparison)},
                         {"differences", differences_of(comparison)},
                         {"warnings", words_of(comparison)}};
  json["files"] = ComparisonJson::array();
  for (const std::filesystem::path& file : summary.files) json["files"].push_back(file.string());
  return json.dump(2, ' ', false, ComparisonJson::error_handler_t::replace);
}

}  // namespace condyle
