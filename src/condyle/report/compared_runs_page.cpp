#include "condyle/report/compared_runs_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "condyle/input_error.h"
#include "condyle/report/compared_words.h"
#include "condyle/report/html.h"
#include "condyle/report/sections.h"
#include "condyle/report/svg_curves.h"
#include "condyle/results/run_view.h"
#include "condyle/verify/verify.h"

namespace condyle {
namespace {

std::string title_of_runs(const RunComparison& comparison) {
  const std::string& title = comparison.runs.front().run->scene.title;
  const bool one = std::all_of(comparison.runs.begin(), comparison.runs.end(),
                               [&](const ComparedRun& of) { return of.run->scene.title == title; });
  std::vector<std::string> names;
  for (const ComparedRun& of : comparison.runs) names.push_back(of.name);
  return one && !title.empty() ? title + ": " + enumerated(names) : enumerated(names);
}

std::string verification_of(const Run& run) {
  try {
    const std::size_t count = verify_run(run).false_poses;
    return count == 0   ? "no pose is false"
           : count == 1 ? "1 pose is false"
                        : fmt::format("{} poses are false", count);
  } catch (const InputError& error) {
    return std::string("not verified: ") + error.what();
  }
}

std::string side_of(const Run& run) {
  if (!run.scene.joint) return "-";
  return run.scene.joint->side == Side::kLeft ? "left" : "right";
}

std::string swept_range(const Run& run) {
  const SweptQuantity swept = swept_quantity(run);
  const std::vector<PoseResult>& poses = run.sweep.poses;
  return fmt::format("{} {} to {}{}", swept.name, at_value(swept, poses.front().value),
                     at_value(swept, poses.back().value), swept.unit_after_number());
}

/// Poses of all runs that are no results, in the order of the runs.
std::string failures_of(const RunComparison& comparison) {
  constexpr std::size_t kMostShown = 60;
  HtmlTable table{"Poses that did not succeed", {"run", "at", "status", "reason"}, {}, {0, 2, 3}};
  std::size_t more = 0;
  for (const ComparedRun& of : comparison.runs) {
    const SweptQuantity swept = swept_quantity(*of.run);
    for (const PoseResult& pose : of.run->sweep.poses) {
      if (pose.converged()) continue;
      if (table.rows.size() < kMostShown)
        table.rows.push_back(
            {of.name, with_unit(swept, pose.value), name(pose.status), pose.reason});
      else
        ++more;
    }
  }
  if (table.rows.empty()) return "";
  return html(table) + (more > 0 ? fmt::format("<p>And {} poses more.</p>\n", more) : "");
}

}  // namespace

std::string run_legend(const RunComparison& comparison) {
  std::string out = "<ul class=\"runs\">\n";
  for (std::size_t r = 0; r < comparison.runs.size(); ++r)
    out += fmt::format("<li>{} {}</li>\n", svg_swatch(r), escaped(comparison.runs[r].name));
  return out + "</ul>\n";
}

std::string compared_status_section(const RunComparison& comparison) {
  HtmlTable table{"",
                  {"run", "scene", "side", "goes over", "poses", "results", "verified"},
                  {},
                  {0, 1, 2, 3, 6}};
  for (const ComparedRun& of : comparison.runs) {
    const SweepResult& sweep = of.run->sweep;
    table.rows.push_back({of.name, of.run->scene.title, side_of(*of.run), swept_range(*of.run),
                          fmt::format("{}", sweep.poses.size()),
                          fmt::format("{}", sweep.count_converged()), verification_of(*of.run)});
    const bool whole = sweep.count_converged() == static_cast<int>(sweep.poses.size());
    table.row_classes.emplace_back(whole ? "" : "failed");
  }
  std::string body = html(table) + failures_of(comparison);
  const std::vector<std::string> words = words_of(comparison);
  if (!words.empty()) body += "<ul class=\"words\">\n";
  for (const std::string& line : words) body += "<li>" + escaped(line) + "</li>\n";
  if (!words.empty()) body += "</ul>\n";
  return section("status", "Runs", body);
}

std::string compared_source_section(const RunComparison& comparison) {
  HtmlTable table{"", {"run", "result file", "written by", "written at (UTC)"}, {}, {0, 1, 2, 3}};
  std::string texts;
  for (const ComparedRun& of : comparison.runs) {
    table.rows.push_back({of.name, of.file, of.run->program, of.run->created});
    texts +=
        details("The scene's text: " + of.name, "<pre>" + escaped(of.run->scene.text) + "</pre>\n");
  }
  return section("source", "Computed from", html(table) + texts);
}

std::string compared_runs_page(const RunComparison& comparison,
                               const ComparedRunsPageOptions& options) {
  const std::vector<std::function<std::string()>> parts = {
      [&] {
        return page_head(title_of_runs(comparison),
                         fmt::format("{} runs compared", comparison.runs.size()));
      },
      [&] { return compared_status_section(comparison); },
      [&] { return compared_scenes_section(comparison); },
      [&] { return compared_differences_section(comparison); },
      [&] { return compared_curves_section(comparison); },
      [&] { return options.pictures ? compared_picture_section(comparison) : std::string(); },
      [&] { return compared_source_section(comparison); }};
  return page_of(parts, options.on_part);
}

}  // namespace condyle
