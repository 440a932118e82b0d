#include "condyle/report/compared_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "condyle/results/run_view.h"

namespace condyle {
namespace {

using Names = std::vector<std::string>;

/// Runs of which something holds.
Names names_of(const RunComparison& comparison, const std::function<bool(const Run&)>& holds) {
  Names names;
  for (const ComparedRun& of : comparison.runs)
    if (holds(*of.run)) names.push_back(of.name);
  return names;
}

const char* verb(const Names& names, const char* one, const char* several) {
  return names.size() == 1 ? one : several;
}

void add_sides(const RunComparison& comparison, Names& words) {
  const auto of_side = [&](Side side) {
    return names_of(comparison, [&](const Run& run) {
      return run.scene.joint && run.scene.joint->side == side;
    });
  };
  const Names left = of_side(Side::kLeft), right = of_side(Side::kRight);
  if (!left.empty() && !right.empty())
    words.push_back(
        fmt::format("Left and right knees: {} {} right, {} left. Joint coordinates and places of "
                    "contact are told "
                    "along each knee's own anatomical axes, so their signs mean the same on both "
                    "sides; insertions "
                    "in the scenes are in the frames of the bones and do not.",
                    enumerated(right), verb(right, "is", "are"), enumerated(left)));
  const Names without =
      names_of(comparison, [](const Run& run) { return !run.scene.joint.has_value(); });
  if (!without.empty() && without.size() < comparison.runs.size())
    words.push_back(fmt::format("{} {} no [joint], so no joint coordinates.", enumerated(without),
                                verb(without, "has", "have")));
}

void add_units(const RunComparison& comparison, Names& words) {
  const Scene& first = comparison.runs.front().run->scene;
  const Names others = names_of(comparison, [&](const Run& run) {
    return run.scene.length_to_mm != first.length_to_mm ||
           run.scene.angle_to_rad != first.angle_to_rad || run.scene.force_to_n != first.force_to_n;
  });
  if (!others.empty())
    words.push_back(
        fmt::format("The {} of {} {} in other units than that of {}: the numbers of scenes "
                    "are as they are written, curves and their differences in those of "
                    "this page.",
                    verb(others, "scene", "scenes"), enumerated(others), verb(others, "is", "are"),
                    comparison.runs.front().name));
}

void add_axes(const RunComparison& comparison, Names& words) {
  for (std::size_t r = 1; r < comparison.runs.size(); ++r)
    if (!comparison.overlaid[r])
      words.push_back(fmt::format(
          "{} goes over {}, {} over {}: their curves are not laid over each other, only least and "
          "greatest values are compared.",
          comparison.runs[r].name, swept_quantity(*comparison.runs[r].run).axis,
          comparison.runs.front().name, comparison.axis));
}

/// Values of the poses that have a result, as on the abscissa.
std::vector<double> places_of_results(const Run& run) {
  std::vector<double> places;
  const double per_value = swept_quantity(run).axis_per_inside;
  for (const PoseResult& pose : run.sweep.poses)
    if (pose.converged()) places.push_back(per_value * pose.value);
  std::sort(places.begin(), places.end());
  return places;
}

void add_places(const RunComparison& comparison, Names& words) {
  const std::vector<double> first = places_of_results(*comparison.runs.front().run);
  Names others;
  for (std::size_t r = 0; r < comparison.runs.size(); ++r) {
    const std::vector<double> places = places_of_results(*comparison.runs[r].run);
    if (places.empty())
      words.push_back(fmt::format("No pose of {} has a result: there is nothing of it to compare.",
                                  comparison.runs[r].name));
    else if (comparison.overlaid[r] && !first.empty() && !same_places(first, places))
      others.push_back(comparison.runs[r].name);
  }
  if (!others.empty())
    words.push_back(
        fmt::format("{} {} results at other values than {}: differences are taken at the values of "
                    "either, where "
                    "one has none straight between its two neighbours, never across a pose without "
                    "a result and "
                    "never beyond the ends.",
                    enumerated(others), verb(others, "has", "have"), comparison.runs.front().name));
}

void add_turning(const RunComparison& comparison, Names& words) {
  for (std::size_t r = 1; r < comparison.runs.size(); ++r) {
    if (!comparison.overlaid[r]) continue;
    const bool turns =
        std::any_of(comparison.curves.begin(), comparison.curves.end(),
                    [&](const auto& c) { return c.of.front() && c.of[r] && !c.differences[r]; });
    if (turns)
      words.push_back(
          fmt::format("{} or {} goes over some values more than once: their curves are "
                      "drawn, differences are not taken.",
                      comparison.runs.front().name, comparison.runs[r].name));
  }
}

/// "Only in A: extra (contact force); xLCL (ligament force, ligament strain)."
void add_lonely(const RunComparison& comparison, Names& words) {
  std::vector<std::pair<std::string, std::map<std::string, Names>>> by_owners;
  for (const ComparedCurve& curve : comparison.curves) {
    Names owners;
    bool missing = false;
    for (std::size_t r = 0; r < comparison.runs.size(); ++r) {
      if (curve.of[r])
        owners.push_back(comparison.runs[r].name);
      else if (comparison.runs[r].run->sweep.count_converged() > 0)
        missing = true;
    }
    if (!missing) continue;
    const std::string key = enumerated(owners);
    auto at = std::find_if(by_owners.begin(), by_owners.end(),
                           [&](const auto& o) { return o.first == key; });
    if (at == by_owners.end()) at = by_owners.insert(by_owners.end(), {key, {}});
    at->second[curve.name].push_back(with_small_letter(without_units(curve.group)));
  }
  for (const auto& [owners, curves] : by_owners) {
    Names items;
    for (const auto& [name, groups] : curves)
      items.push_back(name.empty() ? fmt::format("{}", fmt::join(groups, ", "))
                                   : fmt::format("{} ({})", name, fmt::join(groups, ", ")));
    words.push_back(fmt::format("Only in {}: {}.", owners, fmt::join(items, "; ")));
  }
}

}  // namespace

std::string enumerated(const Names& items) {
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i)
    text += (i == 0 ? "" : i + 1 == items.size() ? " and " : ", ") + items[i];
  return text;
}

std::vector<std::string> words_of(const RunComparison& comparison) {
  Names words;
  add_sides(comparison, words);
  add_units(comparison, words);
  add_axes(comparison, words);
  add_places(comparison, words);
  add_turning(comparison, words);
  add_lonely(comparison, words);
  return words;
}

}  // namespace condyle
