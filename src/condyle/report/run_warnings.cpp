#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "condyle/report/summary_json.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

constexpr std::string_view kWarning = "warning: ";

std::string bare(const std::string& line) { return line.substr(kWarning.size()); }

/// The same remark over many poses is one warning: "flexion 10 to 35 deg: ...".
void add_remarks(const Run& run, std::vector<std::string>& warnings) {
  const std::vector<PoseResult>& poses = run.sweep.poses;
  const SweptQuantity swept = swept_quantity(run);
  for (std::size_t first = 0; first < poses.size();) {
    std::size_t end = first + 1;
    while (end < poses.size() && poses[end].remark == poses[first].remark) ++end;
    if (!poses[first].remark.empty()) {
      const double a = swept.shown(poses[first].value), b = swept.shown(poses[end - 1].value);
      const std::string range =
          end == first + 1 ? fmt::format("{:.6g}", a) : fmt::format("{:.6g} to {:.6g}", a, b);
      warnings.push_back(fmt::format("{} {}{}: {}", swept.name, range, swept.unit_after_number(),
                                     poses[first].remark));
    }
    first = end;
  }
}

}  // namespace

std::vector<std::string> fit_warnings(const std::vector<const FitReport*>& reports) {
  std::vector<std::pair<std::string, std::string>> said;  // warning, surfaces
  for (const FitReport* report : reports) {
    for (const std::string& note : report->notes) {
      if (!is_warning(note)) continue;
      const auto same =
          std::find_if(said.begin(), said.end(), [&](const auto& s) { return s.first == note; });
      if (same == said.end())
        said.emplace_back(note, report->surface);
      else
        same->second += ", " + report->surface;
    }
  }
  std::vector<std::string> warnings;
  for (const auto& [note, surfaces] : said) warnings.push_back(surfaces + ": " + bare(note));
  return warnings;
}

bool is_warning(const std::string& line) { return line.rfind(kWarning, 0) == 0; }

std::vector<std::string> start_and_fit_warnings(const Run& run) {
  std::vector<std::string> warnings;
  for (const std::string& line : run.start)
    if (is_warning(line)) warnings.push_back(bare(line));
  std::vector<const FitReport*> reports;
  for (const RunPatch& patch : run.patches) reports.push_back(&patch.report);
  for (std::string& line : fit_warnings(reports)) warnings.push_back(std::move(line));
  return warnings;
}

std::vector<std::string> run_warnings(const Run& run) {
  std::vector<std::string> warnings = start_and_fit_warnings(run);
  add_remarks(run, warnings);
  return warnings;
}

}  // namespace condyle
