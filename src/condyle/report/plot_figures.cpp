#include "condyle/report/plot_figures.h"

#include <fstream>
#include <iterator>
#include <string_view>

namespace condyle {
namespace {

std::string svg_text(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void replace_all(std::string& text, std::string_view from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// As a part of a page: no prologue, no name spaces, and names of its own, as several plots share
/// one page.
std::string inlined(std::string svg, const std::string& prefix) {
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) return "";
  svg.erase(0, begin);
  for (const char* quote : {"\"", "'"}) {
    const std::string q = quote;
    replace_all(svg, " id=" + q, " id=" + q + prefix);
    replace_all(svg, "href=" + q + "#", "href=" + q + "#" + prefix);
    for (const char* space : {" xmlns=", " xmlns:xlink="}) {
      const std::size_t at = svg.find(space + q);
      if (at == std::string::npos) continue;
      const std::size_t end = svg.find(q, at + std::string(space).size() + 1);
      svg.erase(at, end + 1 - at);
    }
  }
  replace_all(svg, "url(#", "url(#" + prefix);
  return svg;
}

}  // namespace

std::string plot_figure(const std::filesystem::path& svg, const std::string& prefix) {
  return "<figure class=\"plot\">" + inlined(svg_text(svg), prefix) + "</figure>\n";
}

}  // namespace condyle
