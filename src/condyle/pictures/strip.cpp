#include "condyle/pictures/strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <optional>

#include "condyle/input_error.h"
#include "condyle/pictures/annotate.h"
#include "condyle/pictures/page_scales.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

// In units of a page 800 high.
constexpr double kHeight = 800, kHead = 92, kValueLine = 30, kFoot = 112, kBars = 120;
constexpr int kPanelWidth = 340, kWidePanel = 500, kPageHeight = 640, kWidest = 8000;  // [pixel]

void check_panel(const PictureOptions& page, const PictureOptions& panel, std::size_t poses) {
  if (is_drawable(panel) || !is_drawable(page)) return;  // of a page that is none its size is told
  throw InputError(fmt::format(
      "a strip of {} poses on {}x{} pixels leaves {}x{} for each, expected at least {} each way: "
      "fewer poses (--at) or a larger page (--size)",
      poses, page.width, page.height, panel.width, std::max(0, panel.height), kLeastPicture));
}

/// What stands once on the page.
void draw_page_words(const Pen& pen, const PageLayout& page, const Scenery& scenery) {
  draw_title(pen, page.width, scenery.run.scene.title, caption(scenery, false));
  draw_bars(pen, page, scenery);
  draw_directions(pen, page, scenery);
  draw_scale_bar(pen, page, scenery);
  draw_keys(pen, page, scenery);
  if (shows_arrows(scenery)) draw_force_scale(pen, page, scenery);
}

/// Above a panel; of a pose that is no result with a sign and its status.
void draw_value(const Pen& pen, const Eigen::Vector2d& at, const Scenery& scenery) {
  TextStyle value = pen.style(19, kInk, Align::kCenter);
  value.bold = true;
  std::string words = with_unit(swept_quantity(scenery.run), scenery.pose.value);
  if (!scenery.pose.converged()) words += std::string("  ") + name(scenery.pose.status);
  pen.canvas.text(at, words, value);
  if (scenery.pose.converged()) return;
  const double size = 17 * pen.s, half = 0.5 * pen.canvas.text_width(words, value);
  draw_alarm_sign(pen, at - Eigen::Vector2d(half + 1.5 * size, 0), size);
}

}  // namespace

PictureOptions strip_size(View view, std::size_t poses) {
  const bool wide = view == View::kPlateau || view == View::kCondyles;
  const int panel = wide ? kWidePanel : kPanelWidth;
  PictureOptions options;
  const double bars = kBars * kPageHeight / kHeight;
  options.width = std::min(kWidest, static_cast<int>(bars) + panel * static_cast<int>(poses));
  options.width = std::max(options.width, 2 * kPanelWidth + static_cast<int>(bars));
  options.height = kPageHeight;
  return options;
}

Image draw_strip(const Run& run,
                 View view,
                 const std::vector<std::size_t>& poses,
                 const PictureOptions& options) {
  assert(!poses.empty());
  const double s = options.height / kHeight;
  const auto columns = static_cast<int>(poses.size());
  PictureOptions panel = options;
  panel.panel = true;
  panel.width = static_cast<int>(options.width - kBars * s) / columns;
  panel.height = static_cast<int>(options.height - (kHead + kValueLine + kFoot) * s);
  check_panel(options, panel, poses.size());
  KneePictures pictures(run, panel);
  Image page = blank_image(options.width, options.height, {255, 255, 255});
  const int top = static_cast<int>((kHead + kValueLine) * s);
  Canvas canvas(page);
  const Pen pen{canvas, s};
  std::optional<Scenery> common;
  for (int i = 0; i < columns; ++i) {
    const std::size_t pose = poses[static_cast<std::size_t>(i)];
    auto [image, shown] = pictures.draw_shown(view, pose);
    Canvas on_panel(image);
    draw_contact_forces({on_panel, s}, panel.width, shown);
    paste(image, page, i * panel.width, top);
    draw_value(pen, {(i + 0.5) * panel.width, (kHead + 22) * s}, shown);
    if (!common) {
      common.emplace(shown);
      continue;
    }
    common->overlap = std::max(common->overlap, shown.overlap);
    common->marks.insert(common->marks.end(), shown.marks.begin(), shown.marks.end());
  }
  draw_page_words(pen, {options.width, options.height, s, {}}, *common);
  return page;
}

}  // namespace condyle
