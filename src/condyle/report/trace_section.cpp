#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "condyle/report/html.h"
#include "condyle/report/sections.h"

namespace condyle {
namespace {

using Poses = std::vector<PoseResult>;

std::string residuals(const PoseTrace& trace) {
  std::string out;
  for (const double residual : trace.residuals)
    out += (out.empty() ? "" : ", ") + fmt::format("{:.1e}", residual);
  return out.empty() ? "-" : out;
}

/// A bar for each residual, its height the logarithm: full for 1, the least for 1e-14 and below.
std::string bars(const PoseTrace& trace) {
  constexpr std::array<const char*, 8> kBars = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  constexpr double kDecadesABar = 2;
  std::string out;
  for (const double residual : trace.residuals) {
    const double level = 7 + std::log10(std::max(residual, 1e-300)) / kDecadesABar;
    out += kBars[static_cast<std::size_t>(std::clamp(std::lround(level), 0L, 7L))];
  }
  return out;
}

/// "Newton from the pose before it: 23; descent from ...: 1", the most frequent way first.
std::string frequencies(const Poses& poses) {
  std::vector<std::pair<std::string, int>> ways;
  for (const PoseResult& pose : poses) {
    if (pose.trace.route == PoseRoute::kNone) continue;
    const std::string way = in_words(pose.trace);
    const auto at = std::find_if(ways.begin(), ways.end(),
                                 [&](const auto& entry) { return entry.first == way; });
    if (at == ways.end()) {
      ways.emplace_back(way, 1);
    } else {
      ++at->second;
    }
  }
  std::stable_sort(ways.begin(), ways.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string out;
  for (const auto& [way, count] : ways)
    out += fmt::format("{}{}: {}", out.empty() ? "" : "; ", way, count);
  return out.empty() ? "" : "<p>Poses by the way they were found: " + escaped(out) + ".</p>\n";
}

}  // namespace

std::string trace_details(const Poses& poses, const SweptQuantity& swept) {
  if (std::none_of(poses.begin(), poses.end(), [](const PoseResult& p) { return p.trace.told(); }))
    return "";
  HtmlTable table{"Residuals relative to forces and to the model's length",
                  {swept.heading(), "found by", "searches", "closed", "released", "residuals", ""},
                  {},
                  {1, 5, 6}};
  for (const PoseResult& pose : poses) {
    const PoseTrace& trace = pose.trace;
    table.rows.push_back({at_value(swept, pose.value), in_words(trace),
                          fmt::format("{}", trace.searches), fmt::format("{}", trace.closings),
                          fmt::format("{}", trace.openings), residuals(trace), bars(trace)});
    table.row_classes.emplace_back(pose.converged() ? "" : "failed");
  }
  return frequencies(poses) + details("By which way each pose was found", html(table));
}

}  // namespace condyle
