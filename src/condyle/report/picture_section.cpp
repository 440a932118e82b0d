#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <vector>

#include "condyle/pictures/knee_picture.h"
#include "condyle/pictures/plot_run.h"
#include "condyle/pictures/png_file.h"
#include "condyle/pictures/pressure_map.h"
#include "condyle/pictures/sensitivity_map.h"
#include "condyle/pictures/strip.h"
#include "condyle/report/compared_runs_page.h"
#include "condyle/report/html.h"
#include "condyle/report/plot_figures.h"
#include "condyle/report/sections.h"
#include "condyle/results/digest.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostAngles = 4;

/// Evenly over the converged poses, both ends among them; where none converged over those that have
/// a place.
std::vector<std::size_t> chosen_poses(const SweepResult& sweep) {
  const bool results = sweep.count_converged() > 0;
  std::vector<std::size_t> drawable;
  for (std::size_t i = 0; i < sweep.poses.size(); ++i)
    if (results ? sweep.poses[i].converged() : has_place(sweep.poses[i])) drawable.push_back(i);
  const std::size_t n = std::min(kMostAngles, drawable.size());
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < n; ++k)
    chosen.push_back(drawable[n == 1 ? 0 : k * (drawable.size() - 1) / (n - 1)]);
  return chosen;
}

/// Of the poses that are no results the one with a contact farthest beyond an edge.
std::optional<std::size_t> farthest_left_patch(const SweepResult& sweep) {
  std::optional<std::size_t> farthest;
  for (std::size_t i = 0; i < sweep.poses.size(); ++i) {
    const PoseResult& pose = sweep.poses[i];
    if (pose.converged() || !has_place(pose)) continue;
    if (!farthest || beyond_edge(pose) > beyond_edge(sweep.poses[*farthest])) farthest = i;
  }
  return farthest;
}

std::string figure(const Image& image, const std::string& caption, const char* kind) {
  return fmt::format(
      "<figure class=\"{}\"><img src=\"data:image/png;base64,{}\" width=\"{}\" height=\"{}\" "
      "alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
      kind, base64(encode_png(image)), image.width, image.height, escaped(caption),
      escaped(caption));
}

/// "flexion 0°, 40°, 80°, 120°"
std::string angles(const Run& run, const std::vector<std::size_t>& poses) {
  const SweptQuantity swept = swept_quantity(run);
  std::string text = swept.title;
  for (const std::size_t pose : poses)
    text += (pose == poses.front() ? " " : ", ") + with_unit(swept, run.sweep.poses[pose].value);
  return text;
}

/// `whose` begins the caption where a page shows several runs.
std::string strip(const Run& run,
                  View view,
                  const std::vector<std::size_t>& poses,
                  const std::string& whose = "") {
  return figure(draw_strip(run, view, poses, strip_size(view, poses.size())),
                fmt::format("{}{} view: {}", whose, name(view), angles(run, poses)), "strip");
}

std::string single(const Run& run, KneePictures& pictures, View view, std::size_t pose) {
  return figure(
      pictures.draw(view, pose),
      fmt::format("{} view: {}; path of contact over all poses", name(view), angles(run, {pose})),
      "picture");
}

/// Pressure on the plateau and on the condyles, where layers carry.
std::string pressures(const Run& run, const std::vector<std::size_t>& poses) {
  if (!(greatest_pressure(run) > 0)) return "";
  std::string body;
  for (const View view : {View::kPlateau, View::kCondyles}) {
    PictureOptions options = strip_size(view, poses.size());
    options.colors = SurfaceColors::kPressure;
    body +=
        figure(draw_strip(run, view, poses, options),
               fmt::format("{} view, pressure of the layers: {}", name(view), angles(run, poses)),
               "strip");
  }
  return body;
}

/// The plateau and the condyles side by side.
std::string pair_of(const Run& run, KneePictures& pictures, std::size_t pose) {
  std::string body = "<div class=\"pair\">\n";
  for (const View view : {View::kPlateau, View::kCondyles})
    body += single(run, pictures, view, pose);
  return body + "</div>\n";
}

/// Of the poses that have a result those nearest to some places of the abscissa, each once.
std::vector<std::size_t> poses_near(const Run& run, const std::vector<double>& places) {
  const double per_value = swept_quantity(run).axis_per_inside;
  std::vector<std::size_t> found;
  for (const double place : places) {
    std::optional<std::size_t> nearest;
    const auto away = [&](std::size_t i) {
      return std::abs(per_value * run.sweep.poses[i].value - place);
    };
    for (std::size_t i = 0; i < run.sweep.poses.size(); ++i)
      if (run.sweep.poses[i].converged() && (!nearest || away(i) < away(*nearest))) nearest = i;
    if (nearest && (found.empty() || found.back() != *nearest)) found.push_back(*nearest);
  }
  return found;
}

/// Pages of a calibration that are looked at where something else is asked.
bool of_second_rank(const NamedPlot& plot) {
  return plot.name.starts_with("calibration_profiles") ||
         plot.name.starts_with("calibration_other_curves");
}

}  // namespace

std::string picture_section(const Run& run) {
  if (count_with_place(run.sweep) == 0 || (run.bodies.empty() && run.patches.empty())) return "";
  const std::vector<std::size_t> poses = chosen_poses(run.sweep);
  std::string body = strip(run, View::kMedial, poses) + strip(run, View::kAnterior, poses);
  PictureOptions options;
  options.width = 1000;
  options.height = 750;
  KneePictures pictures(run, options);
  body += pair_of(run, pictures, poses[poses.size() / 2]);
  body += pressures(run, poses);
  if (const auto left = farthest_left_patch(run.sweep)) {
    body += "<p>A contact beyond the edge of the known surface: this pose is no result.</p>\n" +
            pair_of(run, pictures, *left);
  }
  return section("pictures", "Pictures", body);
}

std::string compared_picture_section(const RunComparison& comparison) {
  std::vector<double> places;
  const Run& first = *comparison.runs.front().run;
  for (const std::size_t pose : chosen_poses(first.sweep))
    places.push_back(swept_quantity(first).axis_per_inside * first.sweep.poses[pose].value);
  std::string body;
  for (std::size_t r = 0; r < comparison.runs.size(); ++r) {
    const Run& run = *comparison.runs[r].run;
    if (run.bodies.empty() && run.patches.empty()) continue;
    const std::vector<std::size_t> poses =
        comparison.overlaid[r] ? poses_near(run, places) : chosen_poses(run.sweep);
    if (!poses.empty()) body += strip(run, View::kMedial, poses, comparison.runs[r].name + ", ");
  }
  return section("pictures", "Pictures", body);
}

std::string plot_section(const Run& run) {
  if (count_with_place(run.sweep) == 0 && !run.laxity() && !run.calibration()) return "";
  std::vector<NamedPlot> plots = chart_plots(all_charts(run));
  append(plots, plots_of(calibration_pages(run)));
  std::string body, folded;
  int count = 0;
  for (const NamedPlot& plot : plots)
    (of_second_rank(plot) ? folded : body) += plot_figure(plot, fmt::format("plot{}-", ++count));
  if (!folded.empty()) body += details("Profiles and the other coordinates", folded);
  return section("plots", "Plots", body);
}

std::string sensitivity_figure(const Run& run) {
  std::string body;
  for (const NamedPlot& plot : sensitivity_plots(run, 1))
    body += plot_figure(plot, "sensitivities-");
  return body;
}

}  // namespace condyle
