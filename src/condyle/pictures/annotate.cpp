#include "condyle/pictures/annotate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "condyle/pictures/fitted_words.h"
#include "condyle/pictures/label_layout.h"
#include "condyle/pictures/ligament_labels.h"
#include "condyle/pictures/page_scales.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

std::string newtons(double force) {
  if (std::abs(force) < 0.05) return "< 0.1 N";
  return fmt::format("{:.{}f} N", force, std::abs(force) < 9.95 ? 1 : 0);
}

std::string megapascals(double pressure) {
  return pressure < 0.95 ? fmt::format("{:.2g} MPa", pressure)
                         : fmt::format("{:.1f} MPa", pressure);
}

Vector2d on_page(const Scenery& scenery, const Vector3d& p) {
  return scenery.camera.project(p).head<2>();
}

/// The text, cut with an ellipsis where it would be wider than `room`.
std::string cut(const Pen& pen, const std::string& text, double room, const TextStyle& style) {
  return cut_words(text, room,
                   [&](const std::string& words) { return pen.canvas.text_width(words, style); });
}

/// A label as wide as it is: one that its column has no room for begins farther in, over the drawing, and one that would reach
/// farther is cut.
struct FittedLabel {
  Vector2d at;
  std::string name;
  TextStyle style;
};
FittedLabel fitted(const Pen& pen,
                   const PageLayout& page,
                   const PlacedLabel& placed,
                   const std::string& name) {
  const double farthest_in = 130 * pen.s, gap = 6 * pen.s, edge = 12 * pen.s, bars = 108 * pen.s;
  FittedLabel label{placed.at, name,
                    pen.style(15, kInk, placed.left ? Align::kRight : Align::kLeft)};
  label.style.bold = true;
  const double room =
      placed.left ? placed.at.x() - gap - edge : page.width - bars - placed.at.x() - gap;
  label.name = cut(pen, name, room + farthest_in, label.style);
  const double wanted = pen.canvas.text_width(label.name, label.style) - room;
  if (wanted <= 0) return label;
  label.at.x() += placed.left ? wanted : -wanted;
  label.style.halo = static_cast<int>(std::lround(2 * pen.s));
  return label;
}

/// Where they stand.
std::vector<Frame> draw_ligament_labels(const Pen& pen,
                                        const PageLayout& page,
                                        const Scenery& scenery) {
  std::vector<Frame> taken;
  const Frame& d = page.drawing;
  const std::vector<LigamentLabel> labels = ligament_labels(scenery, d);
  std::vector<Vector2d> anchors;
  for (const LigamentLabel& label : labels) anchors.push_back(on_page(scenery, label.anchor));
  const Frame columns{d.left - 18 * pen.s, d.top + 10 * pen.s, d.right + 18 * pen.s,
                      d.bottom - 20 * pen.s};
  for (const PlacedLabel& placed : place_labels(anchors, columns, 38 * pen.s)) {
    const LigamentLabel& label = labels[placed.index];
    const double away = placed.left ? -1 : 1;
    const FittedLabel words = fitted(pen, page, placed, label.name);
    pen.canvas.line(words.at, anchors[placed.index], 1.1 * pen.s, kLeader, 0.9);
    pen.canvas.disc(anchors[placed.index], 2.4 * pen.s, kInk);
    pen.canvas.text(words.at + Vector2d(away * 6 * pen.s, 1 * pen.s), words.name, words.style);
    TextStyle quiet = pen.style(13, kQuiet, words.style.align);
    quiet.halo = words.style.halo;
    const std::string force = label.force != 0 ? newtons(label.force) : "slack";
    pen.canvas.text(words.at + Vector2d(away * 6 * pen.s, 17 * pen.s), force, quiet);
    const double width = 6 * pen.s + std::max(pen.canvas.text_width(words.name, words.style),
                                              pen.canvas.text_width(force, quiet)),
                 x = words.at.x(), y = words.at.y();
    taken.push_back({std::min(x, x + away * width), y - 13 * pen.s, std::max(x, x + away * width),
                     y + 19 * pen.s});
  }
  return taken;
}

bool overlap(const Frame& a, const Frame& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

/// A place beside `at` for a word of the given width that is clear of the words before and on the
/// page: right or left of it, or a little above or below.
Vector2d free_place(const Pen& pen,
                    const Vector2d& at,
                    double width,
                    double page_width,
                    std::vector<Frame>& taken) {
  const double gap = 11 * pen.s, line = 17 * pen.s, edge = 4 * pen.s;
  Frame place{};
  for (const double drop : {0.0, line, -line, 2 * line, -2 * line, 3 * line, -3 * line}) {
    for (double left : {at.x() + gap, at.x() - gap - width}) {
      // Beside the point all of it must fit; above or below it may be moved.
      if (drop != 0) left = std::clamp(left, edge, std::max(edge, page_width - edge - width));
      place = {left, at.y() + drop - 0.5 * line, left + width, at.y() + drop + 0.5 * line};
      const bool free = std::none_of(taken.begin(), taken.end(),
                                     [&](const Frame& other) { return overlap(place, other); });
      if (!free || place.left < edge || place.right > page_width - edge) continue;
      taken.push_back(place);
      taken.back().right += edge;
      return {place.left, place.bottom - 3.5 * pen.s};
    }
  }
  return {place.left, place.bottom};
}

std::string view_words(const Scenery& scenery) {
  switch (scenery.view) {
    case View::kPlateau:
      return "Plateau from above";
    case View::kCondyles:
      return "Condyles from below";
    case View::kExploded:
      return "Exploded view";
    default:
      return capitalized(name(scenery.view)) + " view";
  }
}

std::string in_words(const Scenery& scenery, const ContactMark& mark) {
  std::string words = newtons(mark.force);
  if (scenery.hertz && mark.hertz) words += ", " + megapascals(mark.hertz->peak_pressure);
  if (scenery.colors == SurfaceColors::kPressure && mark.peak_pressure > 0)
    words += ", " + megapascals(mark.peak_pressure);
  if (mark.beyond > 0) words += fmt::format(", {:.1f} mm beyond the edge", mark.beyond);
  return words;
}

constexpr double kSmallest = 0.7;  // of a text's size, to which it may shrink

/// The text at the largest size, down to the smallest, at which it is no wider than `width`.
TextStyle fitted(const Pen& pen, const std::string& text, double width, TextStyle style) {
  const int least = std::max(7, static_cast<int>(std::lround(kSmallest * style.size)));
  const std::string first = shortened(text, kMostLetters);
  while (style.size > least && pen.canvas.text_width(first, style) > width) --style.size;
  return style;
}

/// The text in two lines, divided at the blank nearest to its middle.
std::array<std::string, 2> in_two_lines(const std::string& text) {
  const std::size_t middle = text.size() / 2;
  const std::size_t after = text.find(' ', middle), before = text.rfind(' ', middle);
  if (after == std::string::npos && before == std::string::npos) return {text, ""};
  const bool first = after == std::string::npos ||
                     (before != std::string::npos && middle - before < after - middle);
  const std::size_t at = first ? before : after;
  return {text.substr(0, at), text.substr(at + 1)};
}

}  // namespace

std::string caption(const Scenery& scenery, bool with_value) {
  const SweptQuantity swept = swept_quantity(scenery.run);
  std::string text = view_words(scenery);
  if (scenery.colors == SurfaceColors::kGap) text += "  ·  gap between the surfaces";
  if (scenery.colors == SurfaceColors::kPressure) text += "  ·  pressure of the layers";
  const Anatomy anatomy = anatomy_of(scenery.run.scene);
  if (!anatomy.known && scenery.view != View::kExploded)
    text += " (from " + direction_letter(anatomy, scenery.camera.R_VP.row(2)) + ")";
  if (!with_value) return text;
  if (scenery.run.scene.joint)
    text +=
        fmt::format("  ·  flexion {:g}°",
                    std::round(scenery.pose.joint.flexion * 1800 / std::numbers::pi) / 10 + 0.0);
  if (!swept.flexion && !swept.symbol.empty())
    text += "  ·  " + swept.inside + " " + with_unit(swept, scenery.pose.value);
  return text;
}

void draw_title(const Pen& pen, int width, const std::string& title, const std::string& below) {
  const double room = width - 60 * pen.s;
  TextStyle bold = pen.style(23);
  bold.bold = true;
  bold.halo = std::max(1, pen.size(2.2) - 5);
  const TextStyle style = fitted(pen, title, room, bold);
  pen.canvas.text({30 * pen.s, 44 * pen.s}, cut(pen, title, room, style), style);
  TextStyle quiet = pen.style(17, kQuiet);
  quiet.halo = bold.halo;
  quiet = fitted(pen, below, room, quiet);
  pen.canvas.text({30 * pen.s, 72 * pen.s}, cut(pen, below, room, quiet), quiet);
}

void draw_alarm_sign(const Pen& pen, const Vector2d& corner, double size) {
  const Vector2d at(corner.x(), std::round(corner.y()));  // on whole rows, as colour bars are
  const int rows = static_cast<int>(std::lround(size));
  const double half = 0.58 * size, middle = at.x() + half;
  for (int i = 0; i < rows; ++i) {
    const double reach = half * (i + 0.5) / rows, y = at.y() - rows + i;
    pen.canvas.rectangle({middle - reach, y, middle + reach, y + 1}, kAlarmColor);
  }
  const Rgb paper = {255, 255, 255};
  pen.canvas.line({middle, at.y() - 0.68 * size}, {middle, at.y() - 0.33 * size}, 0.13 * size,
                  paper);
  pen.canvas.disc({middle, at.y() - 0.16 * size}, 0.08 * size, paper);
}

void draw_alarm(const Pen& pen, int width, const Scenery& scenery) {
  const PoseResult& pose = scenery.pose;
  if (pose.converged()) return;
  const std::string words =
      std::string(name(pose.status)) + (pose.reason.empty() ? "" : ": " + pose.reason);
  const double size = 19 * pen.s, left = 30 * pen.s, text = left + 1.5 * size,
               room = width - 30 * pen.s - text;
  draw_alarm_sign(pen, {left, 97 * pen.s}, size);
  TextStyle style = pen.style(15);
  style.bold = true;
  style.halo = std::max(1, pen.size(2.2) - 5);
  const TextStyle one_line = fitted(pen, words, room, style);
  if (pen.canvas.text_width(words, one_line) <= room)
    return pen.canvas.text({text, 95 * pen.s}, words, one_line);
  double y = 92 * pen.s;
  for (const std::string& line : in_two_lines(words)) {
    const TextStyle small = fitted(pen, line, room, one_line);
    pen.canvas.text({text, y}, cut(pen, line, room, small), small);
    y += 15 * pen.s;
  }
}

void draw_contact_forces(const Pen& pen,
                         int page_width,
                         const Scenery& scenery,
                         std::vector<Frame> taken) {
  for (const ContactMark& mark : scenery.marks) {
    if (!(mark.force > 0)) continue;
    const double length = shows_arrows(scenery) ? mark.force * scenery.scales.arrow_mm_per_n : 0;
    const Vector2d at = on_page(scenery, mark.point + length * mark.toward_femur);
    TextStyle style = pen.style(15, kInk, Align::kLeft);
    style.bold = true;
    style.halo = std::max(1, pen.size(2.2) - 5);
    const std::string words = in_words(scenery, mark);
    const double width = pen.canvas.text_width(words, style);
    pen.canvas.text(free_place(pen, at, width, page_width, taken), words, style);
  }
}

void annotate(Image& image, const PageLayout& page, const Scenery& scenery) {
  Canvas canvas(image);
  const Pen pen{canvas, page.scale};
  draw_contact_forces(pen, page.width, scenery, draw_ligament_labels(pen, page, scenery));
  draw_title(pen, page.width, scenery.run.scene.title, caption(scenery));
  draw_alarm(pen, page.width, scenery);
  draw_bars(pen, page, scenery);
  draw_directions(pen, page, scenery);
  draw_scale_bar(pen, page, scenery);
  draw_keys(pen, page, scenery);
  if (shows_arrows(scenery)) draw_force_scale(pen, page, scenery);
}

}  // namespace condyle
