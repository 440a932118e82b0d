/// What a study says in numbers: what explains what, and the bands.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "condyle/report/html.h"
#include "condyle/report/study_page.h"
#include "condyle/results/study_shown.h"
#include "condyle/results/study_words.h"

namespace condyle {
namespace {

constexpr std::size_t kNamed = 3;    // of each quantity
constexpr double kLeastPart = 0.01;  // of the variance, to be named
constexpr std::size_t kWordLigaments = 8, kTableLigaments = 12;

/// "aACL strain 0.62, pPCL strain 0.21"
std::string greatest_in_words(const std::vector<std::string>& names,
                              const std::vector<double>& parts) {
  std::string words;
  const std::vector<std::size_t> order = greatest_first(parts);
  for (std::size_t k = 0; k < std::min(order.size(), kNamed); ++k) {
    if (!(parts[order[k]] >= kLeastPart)) break;
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", names[order[k]],
                         number(parts[order[k]], 2));
  }
  return words.empty() ? "-" : words;
}

std::string widest_in_words(const StudyView& study, const ShownOutput& output) {
  const StudyBand& band = study.all.bands.at(output.index);
  const auto pose = widest_pose(band);
  if (!pose) return "-";
  return short_number(band.sd[*pose]) + output.unit + " at " + shown_pose(study, *pose);
}

/// One sentence: what explains most of most quantities.
std::string in_one_sentence(const StudyView& study, const std::vector<ShownOutput>& outputs) {
  const std::vector<std::string> names = shown_parameters(study);
  std::string words;
  for (const ShownOutput& output : outputs) {
    if (output.group == StudyGroup::kLigament) continue;
    const SweepEffects effects = sweep_effects(study, output.index);
    const std::vector<std::size_t> order = greatest_first(effects.first);
    if (order.empty() || !(effects.first[order[0]] >= kLeastPart)) continue;
    words += fmt::format("{}{} by {} ({:.0f} %)", words.empty() ? "" : ", ", output.name,
                         names[order[0]], 100 * effects.first[order[0]]);
  }
  if (words.empty()) return {};
  return "<p>Over the sweep the greatest part of the variance is explained of " + escaped(words) +
         ".</p>\n";
}

std::string in_brackets(const IndexEstimate& index) {
  return fmt::format("{} ({} to {})", number(index.value, 2), number(index.lower, 2),
                     number(index.upper, 2));
}

/// The greatest of each quantity at each of the poses shown, with its interval.
std::string by_pose(const StudyView& study, const std::vector<ShownOutput>& outputs) {
  HtmlTable table{"The greatest indices at some poses, with 95 % intervals",
                  {"quantity", "at", "number", "first order", "total"},
                  {},
                  {0, 1, 2}};
  const std::vector<std::string> names = shown_parameters(study);
  for (const ShownOutput& output : outputs) {
    const StudyEffects& effects = study.all.effects.at(output.index);
    for (const std::size_t pose : shown_poses(study)) {
      std::vector<double> totals;
      for (const auto& by_parameter : effects.total) totals.push_back(by_parameter.at(pose).value);
      const std::vector<std::size_t> order = greatest_first(totals);
      if (order.empty() || !std::isfinite(totals[order[0]])) continue;
      table.rows.push_back({output.name, shown_pose(study, pose), names.at(order[0]),
                            in_brackets(effects.first.at(order[0]).at(pose)),
                            in_brackets(effects.total[order[0]].at(pose))});
    }
  }
  return table.rows.empty() ? "" : details("At some poses, with intervals", html(table));
}

}  // namespace

std::string study_effect_section(const StudyView& study) {
  const std::vector<ShownOutput> outputs = main_outputs(study, kWordLigaments);
  if (outputs.empty() || study.parameters.empty()) return {};
  const std::vector<std::string> names = shown_parameters(study);
  const bool indices = has_indices(study);
  HtmlTable table{
      indices ? "Sobol's indices over the whole sweep, poses weighted by their variance: the three "
                "greatest of each quantity"
              : "Squares of rank correlations over the whole sweep, poses weighted by their "
                "variance: the three greatest of each quantity",
      {"quantity", "sd where the band is widest", "by itself",
       "with what it does together with others"},
      {},
      {0, 1, 2, 3}};
  if (!indices) table.columns = {"quantity", "sd where the band is widest", "greatest"};
  for (const ShownOutput& output : outputs) {
    const SweepEffects effects = sweep_effects(study, output.index);
    table.rows.push_back(
        {output.name, widest_in_words(study, output), greatest_in_words(names, effects.first)});
    if (indices) table.rows.back().push_back(greatest_in_words(names, effects.total));
  }
  return section(
      "effects", "What explains what",
      (indices ? in_one_sentence(study, outputs) : "") +
          (has_unknown_indices(study) ? "<p>" + escaped(kTooFewSamples) + "</p>\n" : "") +
          (has_chance_ranks(study) ? "<p>" + escaped(kChanceRanks) + "</p>\n" : "") + html(table) +
          (indices ? by_pose(study, outputs) : ""));
}

std::string study_band_section(const StudyView& study) {
  std::string body;
  for (const std::size_t pose : shown_poses(study)) {
    HtmlTable table{
        study.swept.title + " " + shown_pose(study, pose),
        {"quantity", "nominal", "mean", "sd", "5 %", "25 %", "median", "75 %", "95 %", "samples"},
        {}};
    for (const ShownOutput& output : main_outputs(study, kTableLigaments)) {
      const StudyBand& band = study.all.bands.at(output.index);
      const auto of = [&](const std::vector<double>& values) {
        return pose < values.size() ? short_number(values[pose]) : std::string("-");
      };
      std::vector<std::string>& row = table.rows.emplace_back();
      row = {output.name + " [" + study.outputs[output.index].units + "]", of(band.nominal),
             of(band.mean), of(band.sd)};
      for (const std::vector<double>& quantile : band.quantiles) row.push_back(of(quantile));
      row.push_back(pose < band.samples.size() ? fmt::format("{}", band.samples[pose]) : "-");
    }
    if (!table.rows.empty()) body += html(table);
  }
  return body.empty() ? "" : section("bands", "Bands", details("At some poses", body));
}

}  // namespace condyle
