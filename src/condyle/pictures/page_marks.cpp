#include "condyle/pictures/page_marks.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "condyle/pictures/gnuplot_page.h"

namespace condyle {
namespace {

constexpr double kHalfCell = 0.5;

bool known(const std::vector<double>& values, std::size_t i) {
  return i < values.size() && std::isfinite(values[i]);
}

/// From the first to one past the last of following points that all have values.
std::vector<std::pair<std::size_t, std::size_t>> pieces(const Mark& mark) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  bool open = false;
  for (std::size_t i = 0; i < mark.x.size(); ++i) {
    const bool here = known(mark.x, i) && known(mark.low, i) && known(mark.high, i);
    if (here && !open) found.emplace_back(i, i + 1);
    if (here) found.back().second = i + 1;
    open = here;
  }
  return found;
}

/// Of one point a band is a stroke, as a line of one is a dot: "#bf0072B2" for a quarter of an ink.
std::string stroke_of(const Mark& mark, const std::string& piece) {
  return fmt::format(
      "${} using 1:2:(0):($3-$2) with vectors nohead linewidth 9 linecolor rgb '#bf{}' notitle",
      piece, mark.ink.substr(1));
}

MarkScript band(const Mark& mark, const std::string& name) {
  MarkScript script;
  int count = 0;
  for (const auto& [begin, end] : pieces(mark)) {
    std::string lines;
    for (std::size_t i = begin; i < end; ++i)
      lines += fmt::format("{:.6g} {:.6g} {:.6g}\n", mark.x[i], mark.low[i], mark.high[i]);
    const std::string piece = fmt::format("{}piece{}", name, count++);
    script.data += data_block(piece, lines);
    if (!script.command.empty()) script.command += ", ";
    script.command +=
        end == begin + 1
            ? stroke_of(mark, piece)
            : fmt::format("${} using 1:2:3 with filledcurves linecolor '{}' {} notitle", piece,
                          mark.ink, fill_look(mark));
  }
  return script;
}

std::string point_line(const Mark& mark, std::size_t i) {
  return fmt::format("{:.6g} {:.6g}\n", mark.x[i], mark.y[i]);
}

MarkScript line(const Mark& mark, const std::string& name) {
  std::string lines, alone;
  bool any = false;
  for (std::size_t i = 0; i < mark.x.size(); ++i) {
    const bool here = known(mark.x, i) && known(mark.y, i);
    lines += here ? point_line(mark, i) : "\n";
    any |= here;
  }
  if (!any) return {};
  MarkScript script{data_block(name, lines),
                    fmt::format("${} using 1:2 with lines {} notitle", name, line_look(mark))};
  for (const std::size_t i : lone_points(mark.x, mark.y)) alone += point_line(mark, i);
  if (alone.empty()) return script;
  script.data += data_block(name + "alone", alone);
  script.command += fmt::format(
      ", ${}alone using 1:2 with points pointtype {} pointsize {:g} linecolor '{}' notitle", name,
      mark.dashed ? 6 : 7, 0.4 * mark.size, mark.ink);
  return script;
}

MarkScript dots(const Mark& mark, const std::string& name) {
  std::string lines;
  for (std::size_t i = 0; i < mark.x.size(); ++i)
    if (known(mark.x, i) && known(mark.y, i))
      lines += fmt::format("{:.6g} {:.6g} {:.6g}\n", mark.x[i], mark.y[i],
                           known(mark.high, i) ? mark.high[i] : 0);
  if (lines.empty()) return {};
  std::string command;
  if (!mark.high.empty())
    command = fmt::format(
        "${} using 1:2:3 with yerrorbars pointtype 0 linewidth 1.2 linecolor '{}' notitle, ", name,
        mark.ink);
  if (mark.hollow)  // paper within, so that lines do not run through it
    command += fmt::format(
        "${} using 1:2 with points pointtype 7 pointsize {:g} linecolor '#ffffff' notitle, ", name,
        mark.size);
  return {data_block(name, lines),
          command + fmt::format("${} using 1:2 with points {} notitle", name, dot_look(mark))};
}

MarkScript bars(const Mark& mark, const std::string& name) {
  std::string lines;
  for (std::size_t i = 0; i < mark.y.size(); ++i)
    if (known(mark.low, i) && known(mark.high, i))
      lines += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g}\n", mark.high[i], mark.y[i],
                           mark.low[i], mark.high[i], mark.y[i] - mark.size / 2,
                           mark.y[i] + mark.size / 2);
  if (lines.empty()) return {};
  return {data_block(name, lines),
          fmt::format("${} using 1:2:3:4:5:6 with boxxyerror linecolor '{}' {} notitle", name,
                      mark.ink, fill_look(mark))};
}

MarkScript cells(const Mark& mark, const std::string& name) {
  std::string lines;
  for (std::size_t i = 0; i < mark.x.size() && i < mark.colors.size(); ++i) {
    const Rgb& c = mark.colors[i];
    lines += fmt::format("{:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {}\n", mark.x[i], mark.y[i],
                         mark.x[i] - kHalfCell, mark.x[i] + kHalfCell, mark.y[i] - kHalfCell,
                         mark.y[i] + kHalfCell, (c[0] << 16) + (c[1] << 8) + c[2]);
  }
  if (lines.empty()) return {};
  return {data_block(name, lines),
          fmt::format("${} using 1:2:3:4:5:6:7 with boxxyerror linecolor rgb variable fillstyle "
                      "solid noborder notitle",
                      name)};
}

}  // namespace

std::string dot_look(const Mark& mark) {
  return fmt::format("pointtype {} pointsize {:g} linewidth 1.6 linecolor '{}'",
                     mark.hollow ? 6 : 7, mark.size, mark.ink);
}

std::string line_look(const Mark& mark) {
  return fmt::format("linewidth {:g} linecolor '{}' dashtype {}", mark.size, mark.ink,
                     mark.dashed ? 2 : 1);
}

std::string fill_look(const Mark& mark) {
  return mark.kind == Mark::Kind::kBand ? "fillstyle transparent solid 0.25 noborder"
                                        : "fillstyle solid noborder";
}

MarkScript mark_script(const Mark& mark, const std::string& name) {
  switch (mark.kind) {
    case Mark::Kind::kBand:
      return band(mark, name);
    case Mark::Kind::kLine:
      return line(mark, name);
    case Mark::Kind::kDots:
      return dots(mark, name);
    case Mark::Kind::kBars:
      return bars(mark, name);
    case Mark::Kind::kCells:
      return cells(mark, name);
  }
  return {};
}

}  // namespace condyle
