#include "condyle/pictures/page_scales.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "condyle/pictures/color_bar.h"
#include "condyle/pictures/gap_map.h"
#include "condyle/results/run_view.h"
#include "condyle/results/strain_scale.h"

namespace condyle {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kBarHeight = 215;

/// The end of the scale is round, so what is above is greater by more than rounding.
std::string words_above(const PictureScales& scales) {
  if (!(scales.ligament_greatest > scales.ligament_top * (1 + 1e-6))) return "";
  return fmt::format("up to {:.0f}", (scales.strain_known ? 100 : 1) * scales.ligament_greatest);
}

void draw_ligament_bar(const Pen& pen, const PictureScales& scales, const Frame& place) {
  const double factor = scales.strain_known ? 100 : 1;
  draw_color_bar(pen,
                 {ColorMap::kStrain, "Ligament", scales.strain_known ? "strain [%]" : "force [N]",
                  0, factor * scales.ligament_top, words_above(scales)},
                 place);
  const auto key = [&](double below, Rgb color, const char* words) {
    const double y = place.bottom + below * pen.s;
    pen.canvas.line({place.left, y}, {place.right, y}, 3 * pen.s, color);
    pen.canvas.text({place.right + 9 * pen.s, y + 5 * pen.s}, words, pen.style(14));
  };
  key(24, kSlackColor, "slack");
  if (scales.some_unstrained) key(44, kUnstrainedColor, "no strain");
}

/// Overlap has a colour outside of the scale; it is named where it is seen.
void draw_gap_bar(const Pen& pen, double overlap, const Frame& place) {
  draw_color_bar(pen, {ColorMap::kGap, "Gap", "[mm]", 0, kGapLimit}, place);
  if (!(overlap > 0)) return;
  const double top = std::round(place.bottom + 16 * pen.s);
  pen.canvas.rectangle({place.left, top, place.right, std::round(top + 16 * pen.s)}, kAlarmColor);
  TextStyle style = pen.style(14);
  style.bold = true;
  pen.canvas.text({place.right + 9 * pen.s, top + 13 * pen.s}, "overlap", style);
  pen.canvas.text({place.left + 93 * pen.s, top + 34 * pen.s}, overlap_words(overlap),
                  pen.style(14, kInk, Align::kRight));
}

}  // namespace

std::string overlap_words(double overlap) {
  return overlap < 0.01 ? "below 0.01 mm" : fmt::format("up to {:.2g} mm", overlap);
}

void draw_bars(const Pen& pen, const PageLayout& page, const Scenery& scenery) {
  const double left = page.width - 98 * pen.s, right = left + 16 * pen.s;
  const SweptQuantity swept = swept_quantity(scenery.run);
  const PictureScales& scales = scenery.scales;
  double top = 150 * pen.s;
  if (!scenery.run.scene.ligaments.empty()) {
    const Frame place{left, top, right, top + kBarHeight * pen.s};
    draw_ligament_bar(pen, scales, place);
    top = place.bottom + 120 * pen.s;
  }
  const Frame lower{left, top, right, top + kBarHeight * pen.s};
  if (scenery.colors == SurfaceColors::kGap) return draw_gap_bar(pen, scenery.overlap, lower);
  if (scenery.colors == SurfaceColors::kPressure)
    return draw_color_bar(pen, {ColorMap::kPressure, "Pressure", "[MPa]", 0, scenery.pressure_top},
                          lower);
  if (scenery.run.scene.contacts.empty() || !(scales.sweep_high > scales.sweep_low)) return;
  draw_color_bar(
      pen,
      {ColorMap::kFlexion, "Contact path", capitalized(swept.title) + " [" + swept.symbol + "]",
       swept.shown(scales.sweep_low), swept.shown(scales.sweep_high)},
      lower);
}

namespace {

/// One arm of the mark: a line and the letter at its end.
void draw_arm(const Pen& pen,
              const Vector2d& middle,
              const Vector2d& out,
              const std::string& letter) {
  pen.canvas.line(middle, middle + 22 * pen.s * out, 1.4 * pen.s, kLeader);
  const Vector2d away = 12 * pen.s * out.normalized();
  pen.canvas.text(middle + 22 * pen.s * out + away + Vector2d(0, 6 * pen.s), letter,
                  pen.style(16, kInk, Align::kCenter));
}

}  // namespace

void draw_directions(const Pen& pen, const PageLayout& page, const Scenery& scenery) {
  const Anatomy anatomy = anatomy_of(scenery.run.scene);
  const Vector2d middle(66 * pen.s, page.height - 74 * pen.s);
  if (scenery.view == View::kExploded) {
    for (const Vector3d& direction : {anatomy.lateral, anatomy.anterior, anatomy.proximal}) {
      const Vector3d seen = scenery.camera.R_VP * direction;
      draw_arm(pen, middle, 1.35 * Vector2d(seen.x(), -seen.y()),
               direction_letter(anatomy, direction));
    }
    return;
  }
  for (int axis = 0; axis < 2; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const Vector3d direction = sign * scenery.camera.R_VP.row(axis).transpose();
      draw_arm(pen, middle, axis == 0 ? Vector2d(sign, 0) : Vector2d(0, -sign),
               direction_letter(anatomy, direction));
    }
  }
}

double scale_bar_length(double longest) {
  const double decade = std::pow(10, std::floor(std::log10(longest)));
  for (const double step : {5.0, 2.0})
    if (step * decade <= longest) return step * decade;
  return decade;
}

namespace {

constexpr double kScaleBarLeft = 140, kScaleBarRoom = 200;  // [1/900 of the page]

double scale_bar_pixels(const Pen& pen, const Scenery& scenery) {
  const double mm_per_pixel = scenery.camera.mm_per_pixel;
  return scale_bar_length(kScaleBarRoom * pen.s * mm_per_pixel) / mm_per_pixel;
}

}  // namespace

void draw_scale_bar(const Pen& pen, const PageLayout& page, const Scenery& scenery) {
  const double pixels = scale_bar_pixels(pen, scenery), y = page.height - 52 * pen.s,
               x = kScaleBarLeft * pen.s;
  pen.canvas.rectangle({x, y - 2 * pen.s, x + pixels, y + 2 * pen.s}, kInk);
  pen.canvas.text({x + 0.5 * pixels, y - 9 * pen.s},
                  fmt::format("{:g} mm", pixels * scenery.camera.mm_per_pixel),
                  pen.style(14, kInk, Align::kCenter));
}

void draw_force_scale(const Pen& pen, const PageLayout& page, const Scenery& scenery) {
  const double force = round_up_nicely(0.2 * scenery.scales.force_top);
  const double pixels = force * scenery.scales.arrow_mm_per_n / scenery.camera.mm_per_pixel;
  const double y = page.height - 52 * pen.s,
               x = (kScaleBarLeft + 35) * pen.s + scale_bar_pixels(pen, scenery);
  const Vector2d tip(x + pixels, y);
  pen.canvas.line({x, y}, tip - Vector2d(6 * pen.s, 0), 3 * pen.s, kInk);
  for (int i = 0; i <= static_cast<int>(12 * pen.s); ++i) {
    const double half_width = 6 * pen.s * i / (12 * pen.s);
    pen.canvas.line(tip - Vector2d(i, half_width), tip - Vector2d(i, -half_width), 1.2, kInk);
  }
  pen.canvas.text({x + 0.5 * pixels, y - 11 * pen.s}, fmt::format("{:g} N", force),
                  pen.style(14, kInk, Align::kCenter));
}

void draw_keys(const Pen& pen, const PageLayout& page, const Scenery& scenery) {
  const double right = page.width - 30 * pen.s;
  const TextStyle style = pen.style(14, kInk, Align::kRight);
  double y = page.height - 52 * pen.s;
  const auto words = [&](const std::string& text) {
    pen.canvas.text({right, y + 5 * pen.s}, text, style);
    return right - pen.canvas.text_width(text, style) - 12 * pen.s;
  };
  if (std::any_of(scenery.marks.begin(), scenery.marks.end(),
                  [](const ContactMark& mark) { return mark.beyond > 0; })) {
    const double left = words("contact beyond the known surface");
    const Vector2d at(left - 7 * pen.s, y), arm(6 * pen.s, 6 * pen.s), other(arm.x(), -arm.y());
    pen.canvas.line(at - arm, at + arm, 3 * pen.s, kAlarmColor);
    pen.canvas.line(at - other, at + other, 3 * pen.s, kAlarmColor);
    y -= 24 * pen.s;
  }
  if (scenery.staging.apart()) {
    words(fmt::format("femur lifted {:g} mm, tipped {:.0f}°", scenery.staging.lifted,
                      scenery.staging.tipped * 180 / M_PI));
    y -= 24 * pen.s;
  }
  const bool ellipses = std::any_of(scenery.marks.begin(), scenery.marks.end(),
                                    [](const ContactMark& mark) { return mark.hertz.has_value(); });
  if (scenery.hertz && ellipses) {
    const double left = words("Hertz ellipse, to scale; greatest pressure");
    pen.canvas.disc({left - 10 * pen.s, y}, 7 * pen.s, kInk);
    pen.canvas.disc({left - 10 * pen.s, y}, 5.8 * pen.s, kHertzColor);
    y -= 24 * pen.s;
  }
  if (!scenery.run.comparison() || scenery.colors == SurfaceColors::kGap) return;
  const double left = words("contact path of Wismans' model");
  pen.canvas.line({left - 34 * pen.s, y}, {left, y}, 3 * pen.s, kReferenceColor);
  pen.canvas.disc({left - 17 * pen.s, y}, 3.4 * pen.s, kReferenceColor);
}

}  // namespace condyle
