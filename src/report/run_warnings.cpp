#include <fmt/format.h>

#include <string_view>

#include "report/summary_json.h"
#include "scene/sweep_range.h"

namespace condyle {
namespace {

constexpr std::string_view kWarning = "warning: ";

bool is_warning(const std::string& line) { return line.rfind(kWarning, 0) == 0; }
std::string bare(const std::string& line) { return line.substr(kWarning.size()); }

/// The same remark over many poses is one warning: "flexion 10 to 35 deg: ...".
void add_remarks(const Run& run, std::vector<std::string>& warnings) {
  const std::vector<PoseResult>& poses = run.sweep.poses;
  const Unit unit =
      run.scene.sweep ? border_sweep_unit(run.scene) : Unit{run.scene.simulation ? "s" : "1", 1};
  for (std::size_t first = 0; first < poses.size();) {
    std::size_t end = first + 1;
    while (end < poses.size() && poses[end].remark == poses[first].remark) ++end;
    if (!poses[first].remark.empty()) {
      const double a = poses[first].value / unit.factor, b = poses[end - 1].value / unit.factor;
      const std::string range =
          end == first + 1 ? fmt::format("{:.6g}", a) : fmt::format("{:.6g} to {:.6g}", a, b);
      warnings.push_back(fmt::format("{} {}: {}", range, unit.name, poses[first].remark));
    }
    first = end;
  }
}

}  // namespace

std::vector<std::string> run_warnings(const Run& run) {
  std::vector<std::string> warnings;
  for (const std::string& line : run.start)
    if (is_warning(line)) warnings.push_back(bare(line));
  for (const RunPatch& patch : run.patches) {
    for (const std::string& note : patch.report.notes)
      if (is_warning(note)) warnings.push_back(patch.surface + ": " + bare(note));
  }
  add_remarks(run, warnings);
  return warnings;
}

}  // namespace condyle
