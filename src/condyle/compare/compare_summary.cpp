#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/compare/compare.h"
#include "condyle/scene/swept_quantity.h"

namespace condyle {
namespace {

using Lines = std::vector<std::string>;

std::string at_value(const Scene& scene, const SweepResult& sweep, std::size_t pose) {
  const double shown = quantity_of_sweep(scene).shown(sweep.poses.at(pose).value);
  return fmt::format("{:g}", std::round(1e6 * shown) / 1e6);
}

void add_fits(const Scene& scene,
              const std::vector<FittedSurface>& surfaces,
              const Comparison& comparison,
              Lines& lines) {
  lines.push_back(
      fmt::format("{:<20}{:>22}{:>24}", "surface", "polynomial rms, max mm", "patch rms, max mm"));
  for (std::size_t i = 0; i < comparison.heights.size(); ++i) {
    const HeightFit& fit = comparison.heights[i];
    const std::string polynomial =
        fit.fitted ? fmt::format("{:.3f}, {:.3f}", fit.rms, fit.max) : "exact";
    const auto& report = surfaces[i].report;
    const std::string patch =
        report ? fmt::format("{:.3f}, {:.3f}", report->rms, report->max) : "exact";
    lines.push_back(fmt::format("{:<20}{:>22}{:>24}", scene.surfaces[i].name, polynomial, patch));
  }
}

/// "medial contact: reference pulls at 75 to 90 deg, ours is open at 80 to 90 deg": runs of poses.
std::string runs_of(const Scene& scene,
                    const SweepResult& sweep,
                    const std::function<bool(const PoseResult&)>& is) {
  std::string text;
  const std::size_t n = sweep.poses.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!sweep.poses[i].converged() || !is(sweep.poses[i])) continue;
    std::size_t last = i;
    while (last + 1 < n && sweep.poses[last + 1].converged() && is(sweep.poses[last + 1])) ++last;
    text += (text.empty() ? "" : ", ") + at_value(scene, sweep, i);
    if (last > i) text += " to " + at_value(scene, sweep, last);
    i = last;
  }
  return text;
}

void add_contacts(const Scene& scene,
                  const SweepResult& ours,
                  const Comparison& comparison,
                  Lines& lines) {
  const std::string unit = quantity_of_sweep(scene).unit_after_number();
  const auto say = [&](const std::string& what, const std::string& where) {
    if (!where.empty()) lines.push_back(fmt::format("{} at {}{}", what, where, unit));
  };
  for (std::size_t c = 0; c < scene.contacts.size(); ++c) {
    const std::string& name = scene.contacts[c].name;
    say("reference: the " + name + " contact pulls, which it cannot open",
        runs_of(scene, comparison.reference,
                [c](const PoseResult& p) { return p.contacts[c].force < 0; }));
    say("reference: the " + name + " contact is beyond the points of its polynomials",
        runs_of(scene, comparison.reference, [c](const PoseResult& p) {
          return !p.contacts[c].points.empty() && p.contacts[c].points[0].on_edge;
        }));
    say("reference: the surfaces cut into each other beside the " + name + " contact",
        runs_of(scene, comparison.reference, [c](const PoseResult& p) {
          return !p.contacts[c].points.empty() && p.contacts[c].points[0].relative_curvature[0] < 0;
        }));
    say("ours: the " + name + " contact is open",
        runs_of(scene, ours, [c](const PoseResult& p) { return !p.contacts[c].closed; }));
    say("ours: the " + name + " compartment carries in several points",
        runs_of(scene, ours, [c](const PoseResult& p) {
          return p.contacts[c].closed && p.contacts[c].points.size() > 1;
        }));
  }
}

void add_failures(const Scene& scene, const Comparison& comparison, Lines& lines) {
  for (const PoseResult& pose : comparison.reference.poses) {
    if (pose.converged()) continue;
    lines.push_back(fmt::format("reference at {:g}: {}", quantity_of_sweep(scene).shown(pose.value),
                                pose.reason));
  }
  for (const Variant v : {Variant::kSurfaces, Variant::kSprings, Variant::kClosed}) {
    const std::size_t n = comparison.reference.poses.size();
    const int missing = static_cast<int>(n) - comparison.converged[static_cast<std::size_t>(v)];
    if (missing > 0)
      lines.push_back(fmt::format("ours with {} of the reference: {} of {} poses did not converge",
                                  name(v), missing, n));
  }
}

void add_differences(const Scene& scene, const Comparison& comparison, Lines& lines) {
  lines.push_back(fmt::format("{:<28}{:>8}{:>11}{:>11}{:>9}  |{:>10}{:>10}{:>10}{:>11}",
                              "difference", "unit", "rms", "max", "at", "surfaces", "springs",
                              "closed", "all three"));
  for (const ComparedQuantity& quantity : comparison.quantities) {
    const std::vector<double>& ours = quantity.of(Variant::kOurs);
    const Difference all = difference(ours, quantity.of(Variant::kReference));
    std::string line = fmt::format("{:<28}{:>8}", quantity.name, quantity.units);
    if (all.count == 0) {
      lines.push_back(line + fmt::format("{:>11}", "no pose of both"));
      continue;
    }
    line += fmt::format("{:>11.3f}{:>11.3f}{:>9}  |", all.rms, all.max,
                        at_value(scene, comparison.reference, all.at));
    for (const Variant v : {Variant::kSurfaces, Variant::kSprings, Variant::kClosed}) {
      const Difference one = difference(ours, quantity.of(v));
      line += one.count > 0 ? fmt::format("{:>10.3f}", one.rms) : fmt::format("{:>10}", "-");
    }
    const Difference rest =
        difference(quantity.of(Variant::kAllThree), quantity.of(Variant::kReference));
    line += rest.count > 0 ? fmt::format("{:>11.1e}", rest.max) : fmt::format("{:>11}", "-");
    lines.push_back(line);
  }
}

/// "-" where no pose has it.
std::string one_decimal(double number) {
  return std::isfinite(number) ? fmt::format("{:.1f}", number) : "-";
}

}  // namespace

Lines summary_lines(const Scene& scene,
                    const std::vector<FittedSurface>& surfaces,
                    const SweepResult& ours,
                    const Comparison& comparison) {
  Lines lines;
  const std::size_t n = ours.poses.size();
  lines.push_back(fmt::format(
      "ours: {} of {} poses converged; Wismans' model (polynomials of degree {}, quadratic springs "
      "of equal force at a strain of {:g}, two contacts that never open): {} of {}",
      ours.count_converged(), n, comparison.options.degree, comparison.options.strain,
      comparison.reference.count_converged(), n));
  if (!scene.wraps.empty())
    lines.emplace_back("its springs are straight, those of ligaments that wrap too");
  lines.emplace_back();
  add_fits(scene, surfaces, comparison, lines);
  lines.emplace_back();
  add_contacts(scene, ours, comparison, lines);
  add_failures(scene, comparison, lines);
  lines.emplace_back();
  add_differences(scene, comparison, lines);
  lines.emplace_back(
      "(rms and max: reference against ours. surfaces, springs, closed: rms of ours "
      "with that one thing of the reference, against ours.");
  lines.emplace_back(
      " all three: largest difference of the engine's Newton on all three, one contact "
      "in each compartment, from the reference's.)");
  lines.emplace_back();
  lines.push_back(fmt::format(
      "per pose (means and medians): ours {} iterations, {} us; reference {} "
      "iterations of 16 equations, {} us",
      one_decimal(comparison.iterations_ours), one_decimal(1e6 * comparison.seconds_ours),
      one_decimal(comparison.iterations_reference),
      one_decimal(1e6 * comparison.seconds_reference)));
  return lines;
}

}  // namespace condyle
