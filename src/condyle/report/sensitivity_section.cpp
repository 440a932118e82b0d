#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "condyle/equilibrium/sweep_sensitivities.h"
#include "condyle/report/html.h"
#include "condyle/report/sections.h"
#include "condyle/results/sensitivity_effects.h"

namespace condyle {
namespace {

constexpr std::size_t kMostRows = 20;

/// Where a change does the most to an output.
struct Greatest {
  double value = 0;
  std::size_t pose = 0;
  const EffectOutput* output = nullptr;
};

/// Over all poses of the run, of the outputs of each group.
using ByGroup = std::array<Greatest, kEffectGroups>;
ByGroup greatest_effects(const Run& run,
                         const std::vector<EffectOutput>& outputs,
                         std::size_t j,
                         const TypicalChange& change) {
  ByGroup most;
  for (std::size_t pose = 0; pose < run.sweep.poses.size(); ++pose)
    for (const EffectOutput& output : outputs) {
      const double value = effect(run, pose, output, j, change);
      Greatest& here = most[static_cast<std::size_t>(output.group)];
      if (std::abs(value) > std::abs(here.value)) here = {value, pose, &output};
    }
  return most;
}

/// "0.42 mm back at 30°", "12 N more in aACL at 60°"
std::string in_words(const Run& run, const Greatest& most) {
  if (most.output == nullptr) return "-";
  const EffectOutput& output = *most.output;
  std::string text = short_number(std::abs(most.value));
  text += output.group == EffectGroup::kRotation ? "" : " ";
  text += unit_of(output.group);
  text += std::string(" ") + (most.value > 0 ? output.more : output.less);
  const bool of_joint =
      output.group == EffectGroup::kRotation || output.group == EffectGroup::kTranslation;
  if (!of_joint)
    text += (output.group == EffectGroup::kMoment ? " to hold " : " in ") + output.name;
  const SweptQuantity swept = swept_quantity(run);
  return text + " at " + with_unit(swept, run.sweep.poses[most.pose].value);
}

struct RowOfEffects {
  TypicalChange change;
  ByGroup most;
  double weight = 0;  ///< of its greatest effects, as parts of the greatest of all
};

std::vector<RowOfEffects> rows_of(const Run& run, const std::vector<EffectOutput>& outputs) {
  std::vector<RowOfEffects> rows;
  std::array<double, kEffectGroups> largest{};
  for (std::size_t j = 0; j < run.sensitivities->parameters.size(); ++j) {
    const TypicalChange change = typical_change(run.scene, run.sensitivities->parameters[j]);
    rows.push_back({change, greatest_effects(run, outputs, j, change)});
    for (std::size_t g = 0; g < kEffectGroups; ++g)
      largest[g] = std::max(largest[g], std::abs(rows.back().most[g].value));
  }
  for (RowOfEffects& row : rows)
    for (std::size_t g = 0; g < kEffectGroups; ++g)
      if (largest[g] > 0)
        row.weight = std::max(row.weight, std::abs(row.most[g].value) / largest[g]);
  std::stable_sort(rows.begin(), rows.end(), [](const RowOfEffects& a, const RowOfEffects& b) {
    return a.weight > b.weight;
  });
  return rows;
}

std::string cell(const Run& run, const RowOfEffects& row, EffectGroup group) {
  return in_words(run, row.most[static_cast<std::size_t>(group)]);
}

/// Poses at which a contact is about to open or to close.
std::string one_sided(const Run& run) {
  const SweptQuantity swept = swept_quantity(run);
  HtmlTable table{"Poses at which derivatives are those of one side",
                  {swept.heading(), "contacts"},
                  {},
                  {0, 1}};
  for (std::size_t i = 0; i < run.sensitivities->one_sided.size(); ++i)
    if (!run.sensitivities->one_sided[i].empty())
      table.rows.push_back(
          {at_value(swept, run.sweep.poses[i].value), run.sensitivities->one_sided[i]});
  return table.rows.empty() ? "" : html(table);
}

}  // namespace

std::string sensitivity_section(const Run& run, bool with_map) {
  if (!run.sensitivities) return "";
  const std::vector<EffectOutput> outputs = effect_outputs(run);
  const std::vector<RowOfEffects> rows = rows_of(run, outputs);
  HtmlTable table{
      "What a typical change does where it does the most, the tibia seen from the femur; "
      "contacts stay as they are",
      {"change", "moves the tibia", "turns it", "forces", "moments"},
      {},
      {0, 1, 2, 3, 4}};
  for (std::size_t k = 0; k < std::min(kMostRows, rows.size()); ++k) {
    const RowOfEffects& row = rows[k];
    if (!(row.weight > 0)) break;
    table.rows.push_back({row.change.words, cell(run, row, EffectGroup::kTranslation),
                          cell(run, row, EffectGroup::kRotation),
                          cell(run, row, EffectGroup::kForce),
                          cell(run, row, EffectGroup::kMoment)});
  }
  if (table.rows.empty())
    return section("sensitivities", "What moves what",
                   "<p>No pose has derivatives by the numbers that were asked for.</p>\n");
  if (rows.size() > table.rows.size())
    table.caption += fmt::format("; {} of {} numbers", table.rows.size(), rows.size());
  return section("sensitivities", "What moves what",
                 (with_map ? sensitivity_figure(run) : "") + html(table) + one_sided(run));
}

}  // namespace condyle
