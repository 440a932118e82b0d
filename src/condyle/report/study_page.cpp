#include "condyle/report/study_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "condyle/report/html.h"
#include "condyle/results/study_shown.h"
#include "condyle/results/study_words.h"

namespace condyle {
namespace {

std::string percent_of(long part, long whole) {
  return whole > 0 ? fmt::format("{:.3g} %",
                                 100.0 * static_cast<double>(part) / static_cast<double>(whole))
                   : std::string("-");
}

std::string of_knees(const StudyView& study) {
  if (study.knees.size() < 2) return {};
  return fmt::format(" of {} knees, {} of each", study.knees.size(), study.points);
}

/// "1024 samples, design sobol, flexion from 0 to 120 deg"
std::string what_was_studied(const StudyView& study) {
  std::string text =
      fmt::format("Study: {} samples{}, design {}", study.samples, of_knees(study), study.design);
  if (!study.values.empty())
    text += fmt::format(", {} from {:g} to {:g}{}", study.swept.name, study.values.front(),
                        study.values.back(), study.swept.unit_after_number());
  return text;
}

/// Names of those whose quarters differ by more than chance.
std::vector<std::string> uneven_parameters(const StudyView& study) {
  const std::vector<std::string> names = shown_parameters(study);
  std::vector<std::string> uneven;
  for (std::size_t j = 0; j < study.all.failures.by_quartile.size(); ++j)
    if (failures_depend_on(study, j)) uneven.push_back(names.at(j));
  return uneven;
}

std::string bias_warning(const StudyView& study) {
  constexpr std::size_t kMostNames = 4;
  const std::vector<std::string> uneven = uneven_parameters(study);
  if (uneven.empty()) return {};
  std::string names;
  for (std::size_t i = 0; i < std::min(uneven.size(), kMostNames); ++i)
    names += (i > 0 ? ", " : "") + uneven[i];
  if (uneven.size() > kMostNames) names += fmt::format(" and {} more", uneven.size() - kMostNames);
  return fmt::format(
      "Bands and indices are biased: poses without a result depend on {}. What is missing is not "
      "like what is there.",
      names);
}

std::string entry_of(const char* what, const std::string& text) {
  return text.empty() ? "" : fmt::format("<dt>{}</dt><dd>{}</dd>\n", what, escaped(text));
}

}  // namespace

std::string study_status_section(const StudyView& study) {
  const StudyFailures& failures = study.all.failures;
  const bool good = failures.failed == 0;
  std::string body = fmt::format(
      "<p class=\"verdict {}\"><strong>{} of {}</strong> poses have a result; {} of {} samples "
      "have all of theirs</p>\n",
      good ? "good" : "bad", failures.poses - failures.failed, failures.poses,
      study.samples - failures.incomplete, study.samples);
  const std::string bias = bias_warning(study);
  if (!bias.empty()) body += "<ul class=\"warnings\">\n<li>" + escaped(bias) + "</li>\n</ul>\n";
  if (!good && bias.empty())
    body += fmt::format(
        "<p>{} of the poses have none, about as many in each quarter of each number's samples: "
        "bands and indices are of the others.</p>\n",
        percent_of(failures.failed, failures.poses));
  return section("status", "Status and warnings", body);
}

std::string study_parameter_section(const StudyView& study) {
  HtmlTable table{"What varied. Of a factor (log-) sd is that of its logarithm",
                  {"number", "unit", "spread", "sd of the samples"},
                  {},
                  {0, 1, 2}};
  for (const StudyView::Parameter& parameter : study.parameters)
    table.rows.push_back({parameter.name, parameter.logarithmic ? "ln of factor" : parameter.units,
                          parameter.spread, short_number(parameter.typical)});
  const std::string all = html(table);
  constexpr std::size_t kMostShown = 20;
  return section("varied", "What varied",
                 table.rows.size() > kMostShown
                     ? details(fmt::format("{} numbers", table.rows.size()), all)
                     : all);
}

std::string study_failure_section(const StudyView& study) {
  const StudyFailures& failures = study.all.failures;
  if (failures.failed == 0) return {};
  HtmlTable poses{"Poses without a result over the sweep",
                  {study.swept.heading(), "samples", "of all", "why"},
                  {},
                  {0, 3}};
  for (std::size_t i = 0; i < failures.by_pose.size() && i < study.values.size(); ++i) {
    if (failures.by_pose[i] == 0) continue;
    std::string why;
    for (int s = 1; s < kPoseStatusCount && i < failures.by_status.size(); ++s)
      if (const long count = failures.by_status[i][static_cast<std::size_t>(s)]; count > 0)
        why += fmt::format("{}{} {}", why.empty() ? "" : ", ", count,
                           name(static_cast<PoseStatus>(s)));
    poses.rows.push_back({fmt::format("{:g}", study.values[i]),
                          fmt::format("{}", failures.by_pose[i]),
                          percent_of(failures.by_pose[i], study.samples), why});
  }
  HtmlTable quarters{"Share of poses without a result [%] by quarters of each number's samples",
                     {"number", "lowest", "second", "third", "highest"},
                     {}};
  const std::vector<std::string> names = shown_parameters(study);
  for (std::size_t j = 0; j < failures.by_quartile.size(); ++j) {
    std::vector<std::string>& row = quarters.rows.emplace_back();
    row.push_back(names.at(j));
    for (const double share : failures.by_quartile[j]) row.push_back(short_number(100 * share));
  }
  return section("failures", "Poses without a result",
                 html(poses) + (quarters.rows.empty() ? "" : html(quarters)));
}

std::string study_source_section(const StudyView& study, const std::string& file) {
  constexpr std::size_t kMostScenes = 3;
  std::string body = "<dl>\n" + entry_of("Result file", file) +
                     entry_of("Written by", study.program) +
                     entry_of("Written at (UTC)", study.created) +
                     entry_of("Seed", fmt::format("{}", study.seed)) + "</dl>\n";
  body += details("The study's text", "<pre>" + escaped(study.text) + "</pre>\n");
  for (std::size_t k = 0; k < std::min(study.scenes.size(), kMostScenes); ++k)
    body += details("The scene's text: " + (k < study.knees.size() ? study.knees[k] : ""),
                    "<pre>" + escaped(study.scenes[k]) + "</pre>\n");
  if (study.scenes.size() > kMostScenes)
    body += fmt::format("<p>And {} scenes more, in the result file.</p>\n",
                        study.scenes.size() - kMostScenes);
  return section("source", "Computed from", body);
}

std::string study_page(const StudyView& study,
                       const std::string& file,
                       const StudyPageOptions& options) {
  std::vector<std::function<std::string()>> parts = {
      [&] {
        return page_head(study.title.empty() ? "A study" : study.title, what_was_studied(study));
      },
      [&] { return study_status_section(study) + study_parameter_section(study); },
      [&] { return study_effect_section(study); }};
  if (options.pictures) {
    parts.emplace_back([&] { return study_plot_section(study); });
  } else {
    parts.emplace_back([] { return section("plots", "Plots", "<p>Left out on request.</p>\n"); });
  }
  parts.emplace_back([&] { return study_band_section(study) + study_failure_section(study); });
  parts.emplace_back([&] { return study_source_section(study, file); });
  return page_of(parts, options.on_part);
}

}  // namespace condyle
