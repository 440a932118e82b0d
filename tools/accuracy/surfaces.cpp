#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "accuracy/clock.h"
#include "accuracy/shapes.h"
#include "accuracy/study.h"

namespace condyle::accuracy {
namespace {

constexpr double kNoise = 0.1;  // [mm]

struct Fitted {
  PatchFit fit;
  FitErrors errors;
  double milliseconds = 0;
};

Fitted fit(const Shape& shape, const ArticularRegion& region, const FitOptions& options) {
  Fitted fitted;
  fitted.milliseconds =
      processor_microseconds([&] { fitted.fit = fit_patch(region, options); }) / 1000;
  fitted.errors = shape.errors(Patch(fitted.fit.patch));
  return fitted;
}

struct Orders {
  double position = 0, normal = 0, curvature = 0;
};

/// Between knots of `ratio` times the spacing.
Orders orders(const FitErrors& coarse, const FitErrors& fine, double ratio) {
  const double step = std::log(ratio);
  return {std::log(coarse.position / fine.position) / step,
          std::log(coarse.normal / fine.normal) / step,
          std::log(coarse.curvature / fine.curvature) / step};
}

void write(const Shape& shape, double noise, int degree, const Fitted& fitted, fmt::ostream& csv) {
  csv.print("\"{}\",{},{},{},{},{:.2f},{:.3e},{:.3e},{:.3e},{:.0f}\n", shape.name, noise, degree,
            fitted.fit.patch.nu, fitted.fit.patch.nv, fitted.fit.smoothing_length,
            fitted.errors.position, fitted.errors.normal, fitted.errors.curvature,
            fitted.milliseconds);
}

/// What splines can do: no noise, hardly any smoothing, parameters corrected until they settle.
FitOptions precise(int degree) {
  FitOptions options;
  options.degree = degree;
  options.smoothing_length = 0.02;
  options.rounds = 12;
  options.settled = 1e-10;
  return options;
}

/// Knots ever nearer, down to half the spacing; the order since the first row.
Orders add_orders(const Shape& shape, int degree, fmt::ostream& csv, Study& study) {
  FitErrors first;
  Orders observed;
  for (const int cells : {6, 8, 12}) {
    const double ratio = cells / 6.0;
    FitOptions options = precise(degree);
    options.knot_spacing = 4 / ratio;
    if (shape.smooth) options.control_points = {{cells + degree, cells + degree}};
    const Fitted now = fit(shape, shape.exact, options);
    if (ratio > 1)
      observed = orders(first, now.errors, ratio);
    else
      first = now.errors;
    const auto with_order = [&](double error, double order) {
      return fmt::format("{:.1e}", error) + (ratio > 1 ? fmt::format(" ({:.1f})", order) : "");
    };
    study.page += fmt::format(
        "| {} | {} | {} x {} | {} | {} | {} | {:.0f} ms |\n", shape.name, degree, now.fit.patch.nu,
        now.fit.patch.nv, with_order(now.errors.position, observed.position),
        with_order(now.errors.normal, observed.normal),
        with_order(now.errors.curvature, observed.curvature), now.milliseconds);
    write(shape, 0, degree, now, csv);
  }
  return observed;
}

void require_order(double observed, int expected, const std::string& what, Study& study) {
  study.require(std::abs(observed / expected - 1) <= 0.1,
                fmt::format("order {} of {}: {:.2f} observed", expected, what, observed));
}

/// Of a scan, the best one for someone who knows the truth.
Fitted best_fit(const Shape& shape, FitOptions options) {
  Fitted best;
  for (const double length : {1.0, 1.4, 2.0, 2.8, 4.0}) {
    options.smoothing_length = length;
    const Fitted other = fit(shape, shape.noisy, options);
    if (length == 1.0 || other.errors.position < best.errors.position) best = other;
  }
  return best;
}

void add_row(
    const Shape& shape, const Fitted& fitted, const char* smoothing, int degree, Study& study) {
  study.page += fmt::format(
      "| {} | {} | {} x {} | {:.1f}, {} | {:.4f} | {:.2f} | {:.4f} | {:.0f} ms |\n", shape.name,
      degree, fitted.fit.patch.nu, fitted.fit.patch.nv, fitted.fit.smoothing_length, smoothing,
      fitted.errors.position, fitted.errors.normal, fitted.errors.curvature, fitted.milliseconds);
}

void add_noise(const Shape& shape, int degree, double knots, fmt::ostream& csv, Study& study) {
  constexpr double kOwnKnots = 2;
  FitOptions options;
  options.degree = degree;
  options.knot_spacing = knots;
  const Fitted chosen = fit(shape, shape.noisy, options);
  write(shape, kNoise, degree, chosen, csv);
  add_row(shape, chosen, "chosen", degree, study);
  if (knots == kOwnKnots) add_row(shape, best_fit(shape, options), "best", degree, study);
}

}  // namespace

Study study_surfaces(const Setting& setting) {
  fmt::ostream csv = setting.table("surfaces");
  csv.print(
      "shape,noise_mm,degree,control_points_u,control_points_v,smoothing_mm,position_mm,normal_deg,"
      "curvature_per_mm,ms\n");
  Study study;
  study.page =
      "Sheets of 24 mm with 9,409 vertices, errors in the middle 16 mm against the exact surface; "
      "and the phantom's articular surfaces on a grid of 0.7 mm, errors farther than 4 mm from the "
      "edge. All root mean squares. Without noise, in brackets the order observed since the "
      "first of the three:\n\n| shape | degree | control points | position [mm] | normal [°] | "
      "curvature [1/mm] | "
      "fit |\n|---|---|---|---|---|---|---|\n";
  const std::vector<Shape> all = shapes(kNoise);
  Orders cubic;
  for (const Shape& shape : all)
    for (const int degree : {3, 5}) {
      const Orders observed = add_orders(shape, degree, csv, study);
      if (!shape.smooth) continue;
      if (degree == 3) cubic = observed;
      const std::string where = fmt::format("{}, degree {}", shape.name, degree);
      require_order(observed.position, degree + 1, "position, " + where, study);
      require_order(observed.curvature, degree - 1, "curvature, " + where, study);
    }
  study.page +=
      "\nWith 0.1 mm of noise at every vertex alone, and the smoothing length that the program "
      "chooses; with knots 2 mm apart also with the best of five, knowing the truth:\n\n"
      "| shape | degree | control points | smoothing [mm] | position [mm] | normal [°] | curvature "
      "[1/mm] | fit |\n|---|---|---|---|---|---|---|---|\n";
  for (const Shape& shape : all) {
    for (const double knots : {8.0, 4.0, 2.0}) add_noise(shape, 3, knots, csv, study);
    add_noise(shape, 5, 2, csv, study);
  }
  study.in_short = {fmt::format(
      "**Cubic patches are of order {:.1f}, {:.1f} and {:.1f}** in position, normal and curvature "
      "(expected 4, 3, 2). A patch through points without noise is not what limits an answer; the "
      "texture of a real mesh is.",
      cubic.position, cubic.normal, cubic.curvature)};
  return study;
}

}  // namespace condyle::accuracy
