#include "condyle/report/study_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "condyle/contact/pose_status.h"
#include "condyle/results/study_words.h"

namespace condyle {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of_study(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

Json head_of_command(const CommandSummary& summary) {
  Json json = {{"command", summary.command},
               {"version", summary.version},
               {"exit_code", summary.exit_code},
               {"seconds", summary.seconds},
               {"study", summary.output}};
  for (const std::filesystem::path& file : summary.files) json["files"].push_back(file.string());
  json["warnings"] = summary.warnings;
  return json;
}

Json failures_of(const StudyView& view) {
  const StudyFailures& failures = view.all.failures;
  Json json = {{"poses", failures.poses},
               {"failed", failures.failed},
               {"incomplete_samples", failures.incomplete}};
  json["by_status"] = Json::object();
  for (std::size_t i = 0; i < std::size_t{kPoseStatusCount}; ++i) {
    long count = 0;
    for (const std::array<long, 16>& counts : failures.by_status) count += counts[i];
    if (count > 0) json["by_status"][name(static_cast<PoseStatus>(i))] = count;
  }
  json["by_quartile"] = Json::object();
  for (std::size_t i = 0; i < view.parameters.size(); ++i)
    json["by_quartile"][view.parameters[i].name] = failures.by_quartile[i];
  return json;
}

Json output_of(const StudyView& view, std::size_t o) {
  const StudyBand& band = view.all.bands[o];
  Json json = {{"name", view.outputs[o].name}, {"units", view.outputs[o].units}};
  json["nominal"] = band.nominal;
  json["mean"] = band.mean;
  json["sd"] = band.sd;
  for (std::size_t q = 0; q < kBandLevels.size(); ++q)
    json["quantiles"].push_back({{"level", kBandLevels[q]}, {"values", band.quantiles[q]}});
  const std::optional<std::size_t> pose = widest_pose(band);
  if (!pose) return json;
  json["widest_at"] = view.values[*pose];
  const StudyEffects& effects = view.all.effects[o];
  json["largest"] = {{"kind", effects.total.empty() ? "rank correlation" : "total index"},
                     {"by_parameter", Json::object()}};
  for (const EffectSize& effect : largest_effects(view, o, *pose))
    json["largest"]["by_parameter"][view.parameters[effect.parameter].name] = effect.value;
  return json;
}

}  // namespace

std::string json_study(const CommandSummary& summary, const StudyView& view) {
  Json json = head_of_command(summary);
  json["title"] = view.title;
  json["knees"] = view.knees;
  json["design"] = view.design;
  json["seed"] = view.seed;
  json["samples"] = view.samples;
  json["points"] = view.points;
  json["swept"] = {
      {"name", view.swept.name}, {"units", view.swept.unit.name}, {"values", view.values}};
  json["failures"] = failures_of(view);
  json["outputs"] = Json::array();
  for (std::size_t o = 0; o < view.outputs.size(); ++o)
    json["outputs"].push_back(output_of(view, o));
  return text_of_study(json);
}

std::string json_part_of_study(const CommandSummary& summary,
                               std::uint64_t done,
                               std::uint64_t chunks) {
  Json json = head_of_command(summary);
  json["chunks"] = chunks;
  json["chunks_done"] = done;
  return text_of_study(json);
}

}  // namespace condyle
