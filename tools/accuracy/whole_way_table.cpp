#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "accuracy/whole_way.h"

namespace condyle::accuracy {
namespace {

std::string smoothing_of(const Way& way) {
  return way.smoothing == Smoothing::kChosen ? "auto" : fmt::format("{:.1f}", way.length);
}

std::string pair(const Spread& spread, int digits) {
  return spread.count == 0
             ? ""
             : fmt::format("{:.{}f} / {:.{}f}", spread.rms(), digits, spread.greatest, digits);
}

std::string poses_of(const Outcome& outcome) {
  if (!outcome.refused.empty()) return outcome.refused;
  std::string text = fmt::format("{} of {}", outcome.pose.converged, outcome.pose.poses);
  for (const auto& [status, count] : outcome.pose.failures)
    text += fmt::format(", {} {}", count, status);
  return text;
}

}  // namespace

std::string introduction(const PoseErrors& solver) {
  return fmt::format(
      "The phantom knee from mesh files to poses at 0 to 90° in steps of 10°, "
      "against the same sweep on its exact surfaces: root mean square / greatest error of the "
      "poses "
      "that converge. On the exact surfaces themselves steps of 10° and of 5° agree to {:.0e} mm "
      "and {:.0e}°. Rough meshes: five seeds together, correlation 1.5 mm unless named. Smoothing: "
      "`auto` is chosen by the program for each patch, else one length for all. Surface: root mean "
      "square of "
      "the four patches, farther than 4 mm from the edge. Time: from the files to four patches on "
      "two threads (in brackets reading and cleaning alone) + the sweep of ten poses, mean of the "
      "seeds; and the median pose.\n\n| varied | grid [mm] | roughness [mm] | knots [mm] | "
      "smoothing [mm] | surface [mm] | normal [°] | curvature [1/mm] | translation [mm] | rotation "
      "[°] | contact place [mm] | contact force [%] | ligament force [N] | poses | time |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      solver.translation.greatest, solver.rotation.greatest);
}

void write_head(fmt::ostream& csv) {
  csv.print(
      "group,mesh_mm,roughness_mm,seeds,knots_mm,smoothing_mm,surface_mm,normal_deg,"
      "curvature_per_mm,translation_mm,translation_max,rotation_deg,rotation_max,place_mm,"
      "place_max,contact_percent,contact_max,ligament_N,ligament_max,converged,poses,read_ms,"
      "patches_ms,sweep_ms,pose_us\n");
}

std::string row(const Way& way, const Outcome& outcome) {
  const PoseErrors& e = outcome.pose;
  return fmt::format(
      "| {} | {:.1f} | {:.2f} | {:.1f} | {} | {:.4f} | {:.2f} | {:.4f} | {} | {} | {} | {} | {} | "
      "{} | {:.0f} ({:.0f}) + {:.0f} ms, {:.0f} µs |\n",
      way.group, way.cell, way.roughness, way.knots, smoothing_of(way),
      outcome.patch.position.rms(), outcome.patch.normal.rms(), outcome.patch.curvature.rms(),
      pair(e.translation, 3), pair(e.rotation, 3), pair(e.place, 2), pair(e.force, 1),
      pair(e.ligament, 2), poses_of(outcome), outcome.patches_ms, outcome.read_ms,
      outcome.mean_sweep_ms(), outcome.pose_us);
}

void write(const Way& way, const Outcome& outcome, fmt::ostream& csv) {
  csv.print("\"{}\",{},{},{},{},{},{:.5f},{:.3f},{:.5f}", way.group, way.cell, way.roughness,
            way.seeds, way.knots, smoothing_of(way), outcome.patch.position.rms(),
            outcome.patch.normal.rms(), outcome.patch.curvature.rms());
  const PoseErrors& e = outcome.pose;
  for (const Spread* spread : {&e.translation, &e.rotation, &e.place, &e.force, &e.ligament})
    csv.print(",{:.4e},{:.4e}", spread->rms(), spread->greatest);
  csv.print(",{},{},{:.1f},{:.1f},{:.1f},{:.1f}\n", e.converged, e.poses, outcome.read_ms,
            outcome.patches_ms, outcome.mean_sweep_ms(), outcome.pose_us);
}

namespace {

using Ways = std::vector<std::pair<Way, Outcome>>;

/// The cheapest row that is good to 0.1 mm and 0.1 degrees at every pose.
const std::pair<Way, Outcome>* cheapest(const Ways& all) {
  const std::pair<Way, Outcome>* best = nullptr;
  for (const auto& candidate : all) {
    const auto& [way, outcome] = candidate;
    if (way.exact_condyles || way.exact_plateaus || !outcome.complete()) continue;
    if (outcome.pose.translation.greatest > 0.1 || outcome.pose.rotation.greatest > 0.1) continue;
    if (!best || outcome.total_ms() < best->second.total_ms()) best = &candidate;
  }
  return best;
}

}  // namespace

std::string price(const Ways& all) {
  const std::pair<Way, Outcome>* best = cheapest(all);
  if (!best) return "\nNo row is good to 0.1 mm and 0.1° at every pose.\n";
  return fmt::format(
      "\nThe cheapest row that is good to 0.1 mm and 0.1° at every pose: a grid of {:.1f} mm, "
      "roughness {:.2f} mm, knots {:.1f} mm, smoothing {}: {:.0f} ms from the files to ten "
      "poses.\n",
      best->first.cell, best->first.roughness, best->first.knots, smoothing_of(best->first),
      best->second.total_ms());
}

std::vector<std::string> in_short(const Ways& all) {
  const auto rough = std::find_if(all.begin(), all.end(), [](const auto& candidate) {
    return candidate.first.group == "roughness" && candidate.first.roughness == 0.2;
  });
  const std::pair<Way, Outcome>* best = cheapest(all);
  if (!best || rough == all.end()) return {};
  return {fmt::format(
      "**From mesh to pose the mesh's roughness limits the answer**, not its resolution, the "
      "spline "
      "or the solver. Below 0.1 mm and 0.1° at every pose takes a mesh without roughness and a "
      "short smoothing length, and costs {:.0f} ms from two files to ten poses, nearly all of it "
      "reading and fitting. With a roughness of 0.2 mm the same way ends {:.1f} mm and {:.1f}° off "
      "(root mean square).",
      best->second.total_ms(), rough->second.pose.translation.rms(),
      rough->second.pose.rotation.rms())};
}

}  // namespace condyle::accuracy
