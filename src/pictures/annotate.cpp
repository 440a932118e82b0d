#include "pictures/annotate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pictures/label_layout.h"
#include "pictures/ligament_labels.h"
#include "pictures/page_scales.h"
#include "pictures/swept_quantity.h"

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::string newtons(double force) {
  if (force < 0.05) return "< 0.1 N";
  return fmt::format("{:.{}f} N", force, force < 9.95 ? 1 : 0);
}

std::string caption(const Scenery& scenery) {
  const SweptQuantity swept = swept_quantity(scenery.run.scene);
  std::string text =
      capitalized(name(scenery.view)) + (scenery.view == View::kPlateau ? " from above" : " view");
  if (scenery.run.scene.joint) {
    text +=
        fmt::format("  ·  flexion {:g}°",
                    std::round(scenery.pose.joint.flexion * 1800 / std::numbers::pi) / 10 + 0.0);
  }
  const bool varies = scenery.run.scene.sweep || scenery.run.scene.simulation;
  if (!swept.flexion && varies)
    text += "  ·  " + swept.title + " " + with_unit(swept, scenery.pose.value);
  return text;
}

void draw_title(const Pen& pen, const Scenery& scenery) {
  TextStyle title = pen.style(23);
  title.bold = true;
  pen.canvas.text({30 * pen.s, 44 * pen.s}, scenery.run.scene.title, title);
  pen.canvas.text({30 * pen.s, 72 * pen.s}, caption(scenery), pen.style(17, kQuiet));
}

Vector2d on_page(const Scenery& scenery, const Vector3d& p) {
  return scenery.camera.project(p).head<2>();
}

void draw_ligament_labels(const Pen& pen, const PageLayout& page, const Scenery& scenery) {
  const std::vector<LigamentLabel> labels = ligament_labels(scenery);
  std::vector<Vector2d> anchors;
  for (const LigamentLabel& label : labels) anchors.push_back(on_page(scenery, label.anchor));
  const Frame& d = page.drawing;
  const Frame columns{d.left - 18 * pen.s, d.top + 10 * pen.s, d.right + 18 * pen.s,
                      d.bottom - 20 * pen.s};
  for (const PlacedLabel& placed : place_labels(anchors, columns, 38 * pen.s)) {
    const LigamentLabel& label = labels[placed.index];
    const double away = placed.left ? -1 : 1;
    const Align align = placed.left ? Align::kRight : Align::kLeft;
    pen.canvas.line(placed.at, anchors[placed.index], 1.1 * pen.s, kLeader, 0.9);
    pen.canvas.disc(anchors[placed.index], 2.4 * pen.s, kInk);
    TextStyle bold = pen.style(15, kInk, align);
    bold.bold = true;
    pen.canvas.text(placed.at + Vector2d(away * 6 * pen.s, 1 * pen.s), label.name, bold);
    pen.canvas.text(placed.at + Vector2d(away * 6 * pen.s, 17 * pen.s),
                    label.force > 0 ? newtons(label.force) : "slack", pen.style(13, kQuiet, align));
  }
}

bool overlap(const Frame& a, const Frame& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

/// A place beside `at` for a word of the given width that is clear of the words before: right or
/// left of it, or a little above or below.
Vector2d free_place(const Pen& pen, const Vector2d& at, double width, std::vector<Frame>& taken) {
  const double gap = 11 * pen.s, line = 17 * pen.s;
  Frame place{};
  for (const double drop : {0.0, line, -line, 2 * line, -2 * line}) {
    for (const double left : {at.x() + gap, at.x() - gap - width}) {
      place = {left, at.y() + drop - 0.5 * line, left + width, at.y() + drop + 0.5 * line};
      const bool free = std::none_of(taken.begin(), taken.end(),
                                     [&](const Frame& other) { return overlap(place, other); });
      if (!free) continue;
      taken.push_back(place);
      return {place.left, place.bottom - 3.5 * pen.s};
    }
  }
  return {place.left, place.bottom};
}

void draw_contact_forces(const Pen& pen, const Scenery& scenery) {
  std::vector<Frame> taken;
  for (const ContactMark& mark : contact_marks(scenery.run.scene, scenery.pose)) {
    if (!(mark.force > 0)) continue;
    const Vector3d tip =
        mark.point + mark.force * scenery.scales.arrow_mm_per_n * mark.toward_femur;
    const Vector2d at = on_page(scenery, scenery.view == View::kPlateau ? mark.point : tip);
    TextStyle style = pen.style(15, kInk, Align::kLeft);
    style.bold = true;
    style.halo = std::max(1, pen.size(2.2) - 5);
    const double width = pen.canvas.text_width(newtons(mark.force), style);
    pen.canvas.text(free_place(pen, at, width, taken), newtons(mark.force), style);
  }
}

}  // namespace

PageLayout page_layout(int width, int height) {
  const double s = std::min(width / 1200.0, height / 900.0);
  return {width, height, s, {150 * s, 100 * s, width - 235 * s, height - 110 * s}};
}

void annotate(Image& image, const PageLayout& page, const Scenery& scenery) {
  Canvas canvas(image);
  const Pen pen{canvas, page.scale};
  draw_ligament_labels(pen, page, scenery);
  draw_contact_forces(pen, scenery);
  draw_title(pen, scenery);
  draw_bars(pen, page, scenery);
  draw_directions(pen, page, scenery);
  draw_scale_bar(pen, page, scenery);
  if (scenery.run.comparison) draw_reference_key(pen, page);
  const bool arrows =
      scenery.view != View::kPlateau && !contact_marks(scenery.run.scene, scenery.pose).empty();
  if (arrows) draw_force_scale(pen, page, scenery);
}

}  // namespace condyle
