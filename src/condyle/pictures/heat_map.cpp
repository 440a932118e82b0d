#include "condyle/pictures/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/pictures/color_map.h"
#include "condyle/pictures/fitted_words.h"
#include "condyle/pictures/gnuplot_page.h"

namespace condyle {
namespace {

// All in pixels of PNG and SVG; letters in points.
constexpr double kLeastCellWidth = 37, kGroupGap = 12, kPanelGap = 40, kMargin = 22;
constexpr double kTextSize = 10, kCellSize = 7.5, kNoteSize = 10;
constexpr double kTitleHeight = 44, kNoteHeight = 20, kBarHeight = 11, kFoot = 74;
constexpr double kHeadLine = 20;  // of a panel's title, and of what its columns are

double cell_height(const HeatMap& map) {
  if (map.rows.size() <= 12) return 26;
  return map.rows.size() <= 24 ? 21 : 17;
}

/// So many digits that the largest of a scale has three; nothing for what they do not show.
std::string in_cell(double value, double largest) {
  const double digits = 2 - std::floor(std::log10(std::max(largest, 1e-9)));
  std::string text = fmt::format("{:.{}f}", value, static_cast<int>(std::clamp(digits, 0.0, 4.0)));
  if (text.find_first_of("123456789") == std::string::npos) return "";
  if (text.front() == '-') text.replace(0, 1, "−");
  return text;
}

/// Of all columns [pixel]: as wide as the longest number needs.
double cell_width(const HeatMap& map) {
  double width = kLeastCellWidth;
  for (const HeatMap::Panel& panel : map.panels)
    for (std::size_t i = 0; i < panel.values.size(); ++i) {
      const double largest = map.scales[map.columns[i % map.columns.size()].scale].largest;
      if (std::isfinite(panel.values[i]))
        width = std::max(width, words_width(in_cell(panel.values[i], largest), kCellSize) + 5);
    }
  return width;
}

/// Where everything has its place, from the upper left corner of the page.
class Page {
 public:
  explicit Page(const HeatMap& map) : map_(map), cell_width_(cell_width(map)) {
    double x = 0;
    for (std::size_t c = 0; c < map.columns.size(); ++c) {
      if (c > 0 && map.columns[c].scale != map.columns[c - 1].scale) x += kGroupGap;
      lefts_.push_back(x);
      x += cell_width_;
    }
    panel_width_ = x;
    for (const HeatMap::Row& row : map.rows)
      labels_ = std::max(labels_, words_width(row.name + "  " + row.note, kTextSize));
    for (const HeatMap::Column& column : map.columns)
      names_ = std::max(names_, words_width(column.name, kTextSize));
    labels_ += kMargin + 12;
    names_ += 14;
    title_ = page_title(map.title, map.what, width() - 2 * kMargin);
  }

  [[nodiscard]] std::size_t across() const { return std::min(map_.beside, map_.panels.size()); }
  [[nodiscard]] std::size_t down() const {
    return (map_.panels.size() + across() - 1) / std::max<std::size_t>(1, across());
  }
  [[nodiscard]] double width() const {
    const auto n = static_cast<double>(across());
    double words = words_width(map_.what, 1.1 * kTitleSize);
    for (const std::string& note : map_.notes)
      words = std::max(words, words_width(note, kNoteSize));
    return std::max(labels_ + n * panel_width_ + (n - 1) * kPanelGap + kMargin,
                    words + 2 * kMargin);
  }
  [[nodiscard]] const Title& title() const { return title_; }
  [[nodiscard]] double title_height() const {
    return kTitleHeight + kTitleLine * (static_cast<double>(title_.lines.size()) - 1);
  }
  [[nodiscard]] double head() const {
    return title_height() + kNoteHeight * static_cast<double>(map_.notes.size());
  }
  [[nodiscard]] double grid_height() const {
    return cell_height(map_) * static_cast<double>(map_.rows.size());
  }
  [[nodiscard]] double block_height() const { return 2 * kHeadLine + names_ + grid_height() + 22; }
  [[nodiscard]] double height() const {
    return head() + static_cast<double>(down()) * block_height() + kFoot;
  }
  [[nodiscard]] double left(std::size_t panel) const {
    return labels_ + static_cast<double>(panel % across()) * (panel_width_ + kPanelGap);
  }
  /// Of a panel's title; its cells begin below the names of the columns.
  [[nodiscard]] double top(std::size_t panel) const {
    return head() + static_cast<double>(panel / across()) * block_height();
  }
  [[nodiscard]] double cells_top(std::size_t panel) const {
    return top(panel) + 2 * kHeadLine + names_;
  }
  [[nodiscard]] double column_left(std::size_t c) const { return lefts_[c]; }
  [[nodiscard]] double column_width() const { return cell_width_; }

 private:
  const HeatMap& map_;
  double cell_width_;
  std::vector<double> lefts_;
  double panel_width_ = 0, labels_ = 0, names_ = 0;
  Title title_;
};

unsigned color_of(double t) {
  const Rgb rgb = map_color(ColorMap::kDiverging, 0.5 * (1 + t));
  return (static_cast<unsigned>(rgb[0]) << 16U) | (static_cast<unsigned>(rgb[1]) << 8U) | rgb[2];
}

std::string full_title(const HeatMap::Scale& scale) {
  return scale.title + " [" + scale.unit + "]";
}

class Script {
 public:
  Script(const HeatMap& map, PlotFormat format) : map_(map), page_(map), format_(format) {}

  std::string text() {
    for (std::size_t panel = 0; panel < map_.panels.size(); ++panel) add_panel(panel);
    add_bars();
    double y = 0.62 * kTitleHeight;
    for (const std::string& line : page_.title().lines) {
      words(kMargin, y, line, page_.title().size, "left", true);
      y += kTitleLine;
    }
    y = page_.title_height() + 0.35 * kNoteHeight;
    for (const std::string& note : map_.notes) {
      words(kMargin, y, note, kNoteSize, "left", false, "#58606a");
      y += kNoteHeight;
    }
    return head() + "$cells << END_OF_DATA\n" + cells_ + "END_OF_DATA\n$numbers << END_OF_DATA\n" +
           numbers_ + "END_OF_DATA\n" + labels_ + body();
  }

 private:
  [[nodiscard]] double points(double size) const { return letter_size(format_, size); }
  [[nodiscard]] std::string head() const {
    const int w = static_cast<int>(std::ceil(page_.width())),
              h = static_cast<int>(std::ceil(page_.height()));
    return fmt::format(
        "set encoding utf8\nset terminal {} noenhanced background '#ffffff'\nunset key\nunset "
        "border\nunset tics\nset lmargin at screen 0\nset rmargin at screen 1\nset bmargin at "
        "screen 0\nset tmargin at screen 1\nset xrange [0:{}]\nset yrange [{}:0]\nset style fill "
        "solid 1 noborder\n",
        terminal(format_, w, h), w, h);
  }
  [[nodiscard]] std::string body() const {
    return fmt::format(
        "plot $cells using 1:2:3:4:5:6:7 with boxxyerror fillcolor rgb variable linewidth 0, "
        "$numbers using 1:2:3:4 with labels font 'DejaVu Sans,{:g}' textcolor rgb variable\nunset "
        "output\n",
        points(kCellSize));
  }

  void cell(double left, double top, double right, double bottom, unsigned color) {
    cells_ += fmt::format("{:.2f} {:.2f} {:.2f} {:.2f} {:.2f} {:.2f} {}\n", 0.5 * (left + right),
                          0.5 * (top + bottom), left, right, top, bottom, color);
  }
  void words(double x,
             double y,
             const std::string& text,
             double size,
             const char* align,
             bool bold,
             const char* color = "#262c34",
             int turn = 0) {
    labels_ += fmt::format(
        "set label {} at {:.2f},{:.2f} {} rotate by {} font 'DejaVu Sans{},{:g}' textcolor '{}'\n",
        quoted_words(text), x, y, align, turn, bold ? " Bold" : "", points(size), color);
  }

  void add_panel(std::size_t panel) {
    const double left = page_.left(panel), top = page_.cells_top(panel), h = cell_height(map_);
    words(left, page_.top(panel) + 0.5 * kHeadLine, map_.panels[panel].title, 1.15 * kTextSize,
          "left", true);
    add_column_names(left, page_.top(panel));
    for (std::size_t r = 0; r < map_.rows.size(); ++r) {
      const double y = top + h * static_cast<double>(r);
      if (panel % page_.across() == 0) add_row_name(r, left, y + 0.5 * h);
      for (std::size_t c = 0; c < map_.columns.size(); ++c)
        add_value(map_.panels[panel].values[r * map_.columns.size() + c],
                  map_.scales[map_.columns[c].scale].largest, left + page_.column_left(c), y);
    }
  }
  void add_row_name(std::size_t r, double left, double y) {
    const std::string& note = map_.rows[r].note;
    words(left - 8, y, note, kTextSize, "right", false, "#8a929c");
    words(left - 8 - words_width("  " + note, kTextSize), y, map_.rows[r].name, kTextSize, "right",
          false);
  }
  void add_column_names(double left, double top) {
    for (std::size_t c = 0; c < map_.columns.size(); ++c) {
      const double x = left + page_.column_left(c);
      const bool first = c == 0 || map_.columns[c].scale != map_.columns[c - 1].scale;
      if (first)
        words(x, top + 1.5 * kHeadLine, heading(map_.columns[c].scale), kTextSize, "left", false,
              "#58606a");
      words(x + 0.5 * page_.column_width(), page_.cells_top(0) - page_.top(0) + top - 6,
            map_.columns[c].name, kTextSize, "left", false, "#262c34", 90);
    }
  }
  /// Of the columns of a scale, the unit alone where they are few.
  [[nodiscard]] std::string heading(std::size_t scale) const {
    const auto columns =
        std::count_if(map_.columns.begin(), map_.columns.end(),
                      [scale](const HeatMap::Column& column) { return column.scale == scale; });
    const std::string title = full_title(map_.scales[scale]);
    const bool fits =
        words_width(title, kTextSize) < page_.column_width() * static_cast<double>(columns);
    return fits ? title : "[" + map_.scales[scale].unit + "]";
  }
  void add_value(double value, double largest, double left, double top) {
    const double h = cell_height(map_), right = left + page_.column_width() - 1,
                 bottom = top + h - 1;
    if (!std::isfinite(value)) return cell(left, top, right, bottom, 0xE6E8EBU);
    const double t = largest > 0 ? std::clamp(value / largest, -1.0, 1.0) : 0;
    cell(left, top, right, bottom, color_of(t));
    const std::string text = in_cell(value, largest);
    if (text.empty()) return;
    numbers_ += fmt::format("{:.2f} {:.2f} {} {}\n", 0.5 * (left + right), 0.5 * (top + bottom),
                            quoted_words(text), std::abs(t) > 0.62 ? 0xFFFFFFU : 0x262C34U);
  }

  /// One bar for each scale, at the foot of the page.
  void add_bars() {
    const auto n = static_cast<double>(std::max<std::size_t>(1, map_.scales.size()));
    const double room = (page_.width() - 2 * kMargin) / n, length = std::min(200.0, room - 60);
    const double top = page_.height() - kFoot + 18;
    constexpr int kSteps = 101;
    for (std::size_t s = 0; s < map_.scales.size(); ++s) {
      const double left = kMargin + 20 + room * static_cast<double>(s);
      const double least = map_.scales[s].from_zero ? 0 : -1;
      for (int k = 0; k < kSteps; ++k)
        cell(left + length * k / kSteps, top, left + length * (k + 1) / kSteps + 0.3,
             top + kBarHeight, color_of(least + (1 - least) * k / (kSteps - 1)));
      const double below = top + kBarHeight + 10;
      if (least < 0)
        words(left, below, fmt::format("−{:.3g}", map_.scales[s].largest), kCellSize + 1, "center",
              false);
      words(left - least * 0.5 * length, below, "0", kCellSize + 1, "center", false);
      words(left + length, below, fmt::format("{:.3g}", map_.scales[s].largest), kCellSize + 1,
            "center", false);
      words(left + 0.5 * length, below + 15, full_title(map_.scales[s]), kTextSize, "center", false,
            "#58606a");
    }
  }

  const HeatMap& map_;
  Page page_;
  PlotFormat format_;
  std::string cells_, numbers_, labels_;
};

}  // namespace

std::string gnuplot_script(const HeatMap& map, PlotFormat format) {
  return Script(map, format).text();
}

}  // namespace condyle
