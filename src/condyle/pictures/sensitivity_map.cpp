#include "condyle/pictures/sensitivity_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "condyle/equilibrium/sweep_sensitivities.h"
#include "condyle/results/run_view.h"
#include "condyle/results/sensitivity_effects.h"

namespace condyle {
namespace {

constexpr std::size_t kMostRows = 40, kMostLigaments = 12;

/// Effects of all parameters on all outputs at the poses that are shown.
class Effects {
 public:
  explicit Effects(const Run& run)
      : run_(run), outputs_(effect_outputs(run)), poses_(shown_sensitivities(run)) {
    for (const SceneParameter& parameter : run.sensitivities->parameters)
      changes_.push_back(typical_change(run.scene, parameter));
    for (std::size_t j = 0; j < changes_.size(); ++j)
      for (const EffectOutput& output : outputs_) {
        double& largest = largest_[group(output)];
        largest = std::max(largest, greatest(output, j));
      }
  }

  [[nodiscard]] const std::vector<EffectOutput>& outputs() const { return outputs_; }
  [[nodiscard]] const std::vector<std::size_t>& poses() const { return poses_; }
  [[nodiscard]] const TypicalChange& change(std::size_t j) const { return changes_[j]; }
  [[nodiscard]] double largest(std::size_t of_group) const { return largest_[of_group]; }
  [[nodiscard]] static std::size_t group(const EffectOutput& output) {
    return static_cast<std::size_t>(output.group);
  }
  [[nodiscard]] double at(std::size_t pose, const EffectOutput& output, std::size_t j) const {
    return effect(run_, pose, output, j, changes_[j]);
  }
  /// Over the poses.
  [[nodiscard]] double greatest(const EffectOutput& output, std::size_t j) const {
    double most = 0;
    for (const std::size_t pose : poses_) most = std::max(most, std::abs(at(pose, output, j)));
    return most;
  }
  /// Of all parameters.
  [[nodiscard]] double greatest(const EffectOutput& output) const {
    double most = 0;
    for (std::size_t j = 0; j < changes_.size(); ++j) most = std::max(most, greatest(output, j));
    return most;
  }
  /// On all outputs, as a part of the largest of each group.
  [[nodiscard]] double weight(std::size_t j) const {
    double most = 0;
    for (const EffectOutput& output : outputs_)
      if (const double whole = largest(group(output)); whole > 0)
        most = std::max(most, greatest(output, j) / whole);
    return most;
  }

 private:
  const Run& run_;
  std::vector<EffectOutput> outputs_;
  std::vector<std::size_t> poses_;
  std::vector<TypicalChange> changes_;
  std::array<double, kEffectGroups> largest_{};
};

/// The `most` of greatest weight, in the order in which they stand.
template <typename Weight>
std::vector<std::size_t> weightiest(std::size_t count, std::size_t most, const Weight& weight) {
  std::vector<std::size_t> chosen(count);
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  if (count <= most) return chosen;
  std::stable_sort(chosen.begin(), chosen.end(),
                   [&](std::size_t a, std::size_t b) { return weight(a) > weight(b); });
  chosen.resize(most);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// Those that anything moves; of the ligaments' forces the greatest.
std::vector<EffectOutput> shown_outputs(const Effects& effects, const SweepSensitivities& all) {
  std::vector<EffectOutput> moved, shown;
  std::vector<std::size_t> ligaments;
  for (const EffectOutput& output : effects.outputs()) {
    if (!(effects.greatest(output) > 1e-9 * effects.largest(Effects::group(output)))) continue;
    if (all.outputs[output.index].output.kind == OutputKind::kLigamentForce)
      ligaments.push_back(moved.size());
    moved.push_back(output);
  }
  const std::vector<std::size_t> strongest =
      weightiest(ligaments.size(), kMostLigaments,
                 [&](std::size_t k) { return effects.greatest(moved[ligaments[k]]); });
  std::vector<bool> keep(moved.size(), true);
  for (const std::size_t k : ligaments) keep[k] = false;
  for (const std::size_t k : strongest) keep[ligaments[k]] = true;
  for (std::size_t k = 0; k < moved.size(); ++k)
    if (keep[k]) shown.push_back(moved[k]);
  std::stable_sort(shown.begin(), shown.end(),
                   [](const EffectOutput& a, const EffectOutput& b) { return a.group < b.group; });
  return shown;
}

/// Those of groups that have a column, and where each group stands among them.
std::vector<HeatMap::Scale> scales_of(const Effects& effects,
                                      const std::vector<EffectOutput>& outputs,
                                      std::array<std::size_t, kEffectGroups>& places) {
  constexpr std::array<const char*, kEffectGroups> kTitles = {"rotation", "translation", "force",
                                                              "moment"};
  std::vector<HeatMap::Scale> scales;
  for (std::size_t group = 0; group < kEffectGroups; ++group) {
    const bool any = std::any_of(outputs.begin(), outputs.end(), [&](const EffectOutput& output) {
      return Effects::group(output) == group;
    });
    if (!any) continue;
    places[group] = scales.size();
    scales.push_back(
        {kTitles[group], unit_of(static_cast<EffectGroup>(group)), effects.largest(group)});
  }
  return scales;
}

}  // namespace

std::optional<HeatMap> sensitivity_map(const Run& run) {
  if (!run.sensitivities) return std::nullopt;
  const Effects effects(run);
  const std::vector<EffectOutput> outputs = shown_outputs(effects, *run.sensitivities);
  if (effects.poses().empty() || outputs.empty()) return std::nullopt;
  const std::size_t count = run.sensitivities->parameters.size();
  const std::vector<std::size_t> rows =
      weightiest(count, kMostRows, [&](std::size_t j) { return effects.weight(j); });
  HeatMap map;
  map.title = run.scene.title;
  map.what = map.title.empty() ? "What moves what" : "what moves what";
  map.notes = {
      "What a typical change of each number, told after its name, does to the pose; "
      "contacts stay as they are."};
  if (rows.size() < count)
    map.notes.push_back(
        fmt::format("The {} of {} numbers with the greatest effects.", rows.size(), count));
  std::array<std::size_t, kEffectGroups> places{};
  map.scales = scales_of(effects, outputs, places);
  for (const std::size_t j : rows)
    map.rows.push_back({run.sensitivities->parameters[j].name, effects.change(j).amount});
  for (const EffectOutput& output : outputs)
    map.columns.push_back({output.name, places[Effects::group(output)]});
  const SweptQuantity swept = swept_quantity(run);
  for (const std::size_t pose : effects.poses()) {
    HeatMap::Panel panel{swept.title + " " + with_unit(swept, run.sweep.poses[pose].value), {}};
    for (const std::size_t j : rows)
      for (const EffectOutput& output : outputs)
        panel.values.push_back(effects.at(pose, output, j));
    map.panels.push_back(std::move(panel));
  }
  return map;
}

std::vector<NamedPlot> sensitivity_plots(const Run& run, std::size_t beside) {
  std::optional<HeatMap> map = sensitivity_map(run);
  if (!map) return {};
  map->beside = beside;
  return plots_of(std::vector<NamedMap>{{"sensitivities", std::move(*map)}});
}

}  // namespace condyle
