#include "condyle/pictures/chart_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/pictures/fitted_words.h"
#include "condyle/pictures/gnuplot_page.h"
#include "condyle/pictures/page_marks.h"

namespace condyle {
namespace {

constexpr double kEdge = 24;         // free on both sides of a page [pixel]
constexpr double kNoteLine = 22;     // [pixel]
constexpr double kKeyLine = 26;      // [pixel]
constexpr double kSample = 34;       // width of what stands before words of the key [pixel]
constexpr double kGradient = 110;    // and of a colour scale there [pixel]
constexpr double kTicsApart = 50;    // along x, at least [pixel]
constexpr double kWordsSize = 0.85;  // of that of names
constexpr double kXLabelBelow = 40, kYLabelLeft = 66;  // of the axes [pixel]
constexpr double kNoteSize = 10.5, kKeySize = 11, kLabelSize = 11, kTicSize = 10;  // [point]
constexpr double kTicRoom = 74, kTitleRoom = 34, kLabelRoom = 58;  // of a panel's cell [pixel]

double sample_width(const KeyEntry& entry) {
  const bool scale = !entry.samples.empty() && entry.samples[0].kind == Mark::Kind::kCells;
  return scale ? kGradient : kSample;
}

/// Places of the entries of the key, lines downward.
struct KeyPlace {
  double x = 0;
  int line = 0;
};

std::vector<KeyPlace> key_places(const ChartPage& page) {
  std::vector<KeyPlace> places;
  KeyPlace at{kEdge, 0};
  for (const KeyEntry& entry : page.key) {
    const double width = sample_width(entry) + 10 + words_width(entry.words, kKeySize) + 28;
    if (at.x > kEdge && at.x + width > page.width - kEdge) at = {kEdge, at.line + 1};
    places.push_back(at);
    at.x += width;
  }
  return places;
}

Title title_of(const ChartPage& page) {
  return page_title(page.title, page.what, page.width - 2 * kEdge);
}

double notes_top(const ChartPage& page) { return head_height(title_of(page)) - 22.0; }

double key_top(const ChartPage& page) {
  return notes_top(page) + kNoteLine * static_cast<double>(page.notes.size());
}

std::string range(const std::array<double, 2>& ends) {
  const auto end = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string("*");
  };
  return "[" + end(ends[0]) + ":" + end(ends[1]) + "]";
}

/// The range that is given; else, where that is asked for and nothing lies below, from 0.
std::array<double, 2> y_range_of(const PagePanel& panel) {
  std::array<double, 2> ends = panel.y_range;
  const auto negative = [](const std::vector<double>& values) {
    return std::any_of(values.begin(), values.end(), [](double value) { return value < 0; });
  };
  if (panel.from_zero &&
      std::none_of(panel.marks.begin(), panel.marks.end(),
                   [&](const Mark& mark) { return negative(mark.y) || negative(mark.low); }))
    ends[0] = 0;
  return ends;
}

/// The range that is given; about the only x that there is, where there is but one: gnuplot would
/// take a hundredth of it.
std::array<double, 2> x_range_of(const PagePanel& panel) {
  if (std::isfinite(panel.x_range[0]) || std::isfinite(panel.x_range[1])) return panel.x_range;
  double low = 1e300, high = -1e300;
  for (const Mark& mark : panel.marks)
    for (const double x : mark.x)
      if (std::isfinite(x)) low = std::min(low, x), high = std::max(high, x);
  if (low != high) return panel.x_range;
  const double half = std::max(1., 0.1 * std::abs(low));
  return {low - half, low + half};
}

/// To gnuplot a name on an axis is a format of its number.
std::string tic_words(const std::string& text) {
  std::string format;
  for (const char c : text) format.append(c == '%' ? 2 : 1, c);
  return quoted_words(format);
}

/// Names of 0, 1, ... along an axis.
std::string names(const char* axis, const std::vector<std::string>& list, const char* more) {
  std::string tics = fmt::format("set {} (", axis);
  for (std::size_t i = 0; i < list.size(); ++i)
    tics += fmt::format("{}{} {}", i == 0 ? "" : ", ", tic_words(list[i]), i);
  return tics + ") " + more + "\n";
}

/// The place of pixels as gnuplot has them.
std::string screen(const ChartPage& page, double x, double y) {
  return fmt::format("screen {:.5f}, screen {:.5f}", x / page.width, 1 - y / page.height);
}

/// The colours of cells side by side.
std::string scale_script(const ChartPage& page, const Mark& cells, double x, double y) {
  std::string script;
  const double each = kGradient / static_cast<double>(cells.colors.size());
  for (std::size_t i = 0; i < cells.colors.size(); ++i) {
    const Rgb& c = cells.colors[i];
    const double left = x + each * static_cast<double>(i);
    script += fmt::format(
        "set object rectangle from {} to {} fillcolor '#{:02x}{:02x}{:02x}' fillstyle solid "
        "noborder\n",
        screen(page, left, y - 7), screen(page, left + each, y + 7), c[0], c[1], c[2]);
  }
  return script;
}

std::string key_script(const ChartPage& page, PlotFormat format) {
  const std::vector<KeyPlace> places = key_places(page);
  std::string script;
  for (std::size_t i = 0; i < page.key.size(); ++i) {
    const double x = places[i].x, y = key_top(page) + kKeyLine * (places[i].line + 0.5);
    const double wide = sample_width(page.key[i]);
    for (const Mark& sample : page.key[i].samples) {
      const std::string middle = screen(page, x + kSample / 2, y);
      if (sample.kind == Mark::Kind::kDots) {
        if (!sample.high.empty())
          script += fmt::format("set arrow from {} to {} nohead linewidth 1.2 linecolor '{}'\n",
                                screen(page, x + kSample / 2, y - 9),
                                screen(page, x + kSample / 2, y + 9), sample.ink);
        script += "set label '' at " + middle + " point " + dot_look(sample) + "\n";
      } else if (sample.kind == Mark::Kind::kLine) {
        script += fmt::format("set arrow from {} to {} nohead {}\n", screen(page, x, y),
                              screen(page, x + kSample, y), line_look(sample));
      } else if (sample.kind == Mark::Kind::kCells) {
        script += scale_script(page, sample, x, y);
      } else {
        script += fmt::format("set object rectangle from {} to {} fillcolor '{}' {}\n",
                              screen(page, x, y - 7), screen(page, x + kSample, y + 7), sample.ink,
                              fill_look(sample));
      }
    }
    script += fmt::format("set label {} at {} font 'DejaVu Sans,{:g}' textcolor '#303840'\n",
                          quoted_words(page.key[i].words), screen(page, x + wide + 10, y),
                          letter_size(format, kKeySize));
  }
  return script;
}

std::string note_script(const ChartPage& page, PlotFormat format) {
  std::string script;
  for (std::size_t i = 0; i < page.notes.size(); ++i)
    script += fmt::format(
        "set label {} at {} font 'DejaVu Sans,{:g}' textcolor '#5a646e'\n",
        quoted_words(page.notes[i]),
        screen(page, kEdge, notes_top(page) + kNoteLine * (static_cast<double>(i) + 0.5)),
        letter_size(format, kNoteSize));
  return script;
}

std::string axis_labels(const PagePanel& panel, const ChartPage& page, double size) {
  const auto label = [&](const std::string& text, double x, double y, const char* more) {
    if (text.empty()) return std::string();
    return fmt::format("set label {} at {} center {} font 'DejaVu Sans,{:g}' textcolor '#303840'\n",
                       quoted_words(text), screen(page, x, y), more, size);
  };
  return label(panel.x_label, panel.left + panel.width / 2, panel.top + panel.height + kXLabelBelow,
               "") +
         label(panel.y_label, panel.left - kYLabelLeft, panel.top + panel.height / 2,
               "rotate by 90");
}

/// 1, 2 or 5 of a power of ten, so that tics along x stand apart; free where the range is.
std::string tics_along_x(const PagePanel& panel) {
  const std::array<double, 2> ends = x_range_of(panel);
  const double span = std::abs(ends[1] - ends[0]);
  if (!std::isfinite(span) || !(span > 0)) return "autofreq";
  const double least = span * kTicsApart / panel.width;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double round : {1.0, 2.0, 5.0})
    if (round * power >= least) return fmt::format("{:g}", round * power);
  return fmt::format("{:g}", 10 * power);
}

std::string axes(const PagePanel& panel, const ChartPage& page, PlotFormat format) {
  const auto size = [&](double points) { return letter_size(format, points); };
  std::string script = fmt::format(
      "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\nset tmargin at screen "
      "{:.5f}\nset bmargin at screen {:.5f}\n",
      panel.left / page.width, (panel.left + panel.width) / page.width, 1 - panel.top / page.height,
      1 - (panel.top + panel.height) / page.height);
  script +=
      "set xrange " + range(x_range_of(panel)) + "\nset yrange " + range(y_range_of(panel)) + "\n";
  script += panel.log_y ? "set logscale y\nset format y '%g'\n"
                        : "unset logscale y\nset format y '% h'\n";
  script += panel.frame ? "set border 3\n" : "set border 0\n";
  const std::string small = fmt::format("font 'DejaVu Sans,{:g}'", size(kTicSize));
  const std::string named = fmt::format("scale 0 font 'DejaVu Sans,{:g}'", size(panel.name_size));
  script += "set xtics " + tics_along_x(panel) + " norotate scale 0.6 offset 0,0.25 " + small +
            "\nset ytics autofreq scale 0.6 " + small + "\n";
  if (!panel.x_names.empty())
    script += names("xtics", panel.x_names, ("rotate by 90 right offset 0,0 " + named).c_str());
  if (!panel.y_names.empty()) script += names("ytics", panel.y_names, named.c_str());
  script += panel.frame ? "set grid\n" : "unset grid\n";
  script += axis_labels(panel, page, size(kLabelSize));
  if (!panel.title.empty())
    script += fmt::format("set label {} at {} font 'DejaVu Sans Bold,{:g}' textcolor '#303840'\n",
                          quoted_words(panel.title), screen(page, panel.left, panel.top - 14),
                          size(kLabelSize));
  for (std::size_t i = 0; i < panel.right_names.size(); ++i)
    script += fmt::format(
        "set label {} at graph 1.03, first {} left font 'DejaVu Sans,{:g}' textcolor '#5a646e'\n",
        quoted_words(panel.right_names[i]), i, size(panel.name_size));
  for (const Words& words : panel.words)
    script += fmt::format(
        "set label {} at first {:.6g}, first {:.6g} center font 'DejaVu Sans,{:g}' textcolor '{}' "
        "front\n",
        quoted_words(words.text), words.x, words.y, size(kWordsSize * panel.name_size),
        words.light ? "#ffffff" : "#303840");
  return script;
}

/// Axes alone. Ranges that are given stay, and with them what is named along them.
std::string without_marks(const PagePanel& panel) {
  const auto free = [](const std::array<double, 2>& ends) {
    return !std::isfinite(ends[0]) || !std::isfinite(ends[1]);
  };
  std::string script;
  if (free(panel.x_range)) script += "set xrange [0:1]\n";
  if (free(panel.y_range)) script += "unset logscale y\nset yrange [0:1]\n";
  return script + "plot NaN notitle";
}

std::string panel_script(const ChartPage& page, std::size_t index, PlotFormat format) {
  const PagePanel& panel = page.panels[index];
  std::string script = axes(panel, page, format), commands;
  for (std::size_t i = 0; i < panel.marks.size(); ++i) {
    const MarkScript mark = mark_script(panel.marks[i], fmt::format("panel{}mark{}", index, i));
    script += mark.data;
    if (!mark.command.empty()) commands += (commands.empty() ? "plot " : ", ") + mark.command;
  }
  if (commands.empty()) commands = without_marks(panel);
  return script + commands + "\nunset label\nunset object\nunset arrow\n";
}

}  // namespace

double top_of_panels(const ChartPage& page) {
  const std::vector<KeyPlace> places = key_places(page);
  return key_top(page) + (places.empty() ? 0 : kKeyLine * (places.back().line + 1)) + 8;
}

void lay_in_grid(ChartPage& page, int columns, double panel_height) {
  const double cell = (page.width - 2 * kEdge) / columns,
               row = panel_height + kTitleRoom + kLabelRoom;
  const double top = top_of_panels(page);
  for (std::size_t i = 0; i < page.panels.size(); ++i) {
    PagePanel& panel = page.panels[i];
    panel.left = kEdge + cell * static_cast<double>(i % columns) + kTicRoom;
    panel.top = top + row * static_cast<double>(i / columns) + kTitleRoom;
    panel.width = cell - kTicRoom - 14;
    panel.height = panel_height;
  }
  const std::size_t rows = (page.panels.size() + columns - 1) / columns;
  page.height = static_cast<int>(std::ceil(top + row * static_cast<double>(rows) + 6));
}

std::vector<NamedPage> divided(const std::vector<NamedPage>& pages,
                               std::size_t most,
                               int columns,
                               double panel_height) {
  std::vector<NamedPage> parts;
  for (const auto& [name, page] : pages) {
    const std::vector<PagePanel>& panels = page.panels;
    const std::size_t count = (panels.size() + most - 1) / most;
    for (std::size_t k = 0; k < count; ++k) {
      ChartPage part = page;
      const auto at = [&](std::size_t i) {
        return panels.begin() + static_cast<std::ptrdiff_t>(std::min(i, panels.size()));
      };
      part.panels.assign(at(k * most), at((k + 1) * most));
      if (count > 1) part.what += fmt::format(" ({} of {})", k + 1, count);
      lay_in_grid(part, columns, panel_height);
      parts.push_back({count > 1 ? fmt::format("{}_{}", name, k + 1) : name, std::move(part)});
    }
  }
  return parts;
}

std::string gnuplot_script(const ChartPage& page, PlotFormat format) {
  std::string script = plot_style(format, page.width, page.height) +
                       "set offsets 0, 0, graph 0.05, graph 0.05\nunset key\nset multiplot\n" +
                       title_labels(title_of(page), kEdge / page.width, format, page.height) +
                       note_script(page, format) + key_script(page, format);
  for (std::size_t i = 0; i < page.panels.size(); ++i) script += panel_script(page, i, format);
  return script + "unset multiplot\nunset output\n";
}

}  // namespace condyle
