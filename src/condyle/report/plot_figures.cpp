#include "condyle/report/plot_figures.h"

#include <string_view>

namespace condyle {
namespace {

void replace_all(std::string& text, std::string_view from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// Attributes of one tag as part of a page: no name spaces, and names of its own, as several plots share one page.
std::string inlined_tag(std::string tag, const std::string& prefix) {
  for (const char* quote : {"\"", "'"}) {
    const std::string q = quote;
    replace_all(tag, " id=" + q, " id=" + q + prefix);
    replace_all(tag, "href=" + q + "#", "href=" + q + "#" + prefix);
    for (const char* space : {" xmlns=", " xmlns:xlink="}) {
      const std::size_t at = tag.find(space + q);
      if (at == std::string::npos) continue;
      const std::size_t end = tag.find(q, at + std::string(space).size() + 1);
      if (end != std::string::npos) tag.erase(at, end + 1 - at);
    }
  }
  replace_all(tag, "url(#", "url(#" + prefix);
  return tag;
}

/// Without its prologue; words between tags stay as they are.
std::string inlined(const std::string& svg, const std::string& prefix) {
  std::size_t done = svg.find("<svg");
  if (done == std::string::npos) return "";
  std::string result;
  for (;;) {
    const std::size_t begin = svg.find('<', done), end = svg.find('>', begin);
    if (end == std::string::npos) return result.append(svg, done);
    result.append(svg, done, begin - done);
    result += inlined_tag(svg.substr(begin, end + 1 - begin), prefix);
    done = end + 1;
  }
}

}  // namespace

std::string plot_figure(const NamedPlot& plot, const std::string& prefix) {
  return "<figure class=\"plot\">" + inlined(svg_of(plot), prefix) + "</figure>\n";
}

}  // namespace condyle
