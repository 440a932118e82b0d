#include "condyle/report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/report/embedded.h"

namespace condyle {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string script_safe(std::string_view json) {
  std::string out;
  for (const char c : json) {
    if (c == '<' || c == '>' || c == '&')
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out;
}

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool zero = text.find_first_of("123456789") == std::string::npos;
  return zero && text[0] == '-' ? text.substr(1) : text;
}

std::string short_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.3g}", value) : "-";
}

std::string html(const HtmlTable& table) {
  const auto text_class = [&](std::size_t column) {
    const auto& list = table.text_columns;
    return std::find(list.begin(), list.end(), static_cast<int>(column)) == list.end()
               ? ""
               : " class=\"text\"";
  };
  std::string out = "<div class=\"table\"><table>";
  if (!table.caption.empty()) out += "<caption>" + escaped(table.caption) + "</caption>";
  out += "<thead><tr>";
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    out += fmt::format("<th scope=\"col\"{}>{}</th>", text_class(k), escaped(table.columns[k]));
  out += "</tr></thead>\n<tbody>";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const bool classed = i < table.row_classes.size() && !table.row_classes[i].empty();
    out += classed ? fmt::format("<tr class=\"{}\">", table.row_classes[i]) : "<tr>";
    for (std::size_t k = 0; k < table.rows[i].size(); ++k)
      out += fmt::format("<td{}>{}</td>", text_class(k), escaped(table.rows[i][k]));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string section(std::string_view id, std::string_view title, const std::string& body) {
  if (body.empty()) return "";
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, escaped(title), body);
}

std::string details(std::string_view title, const std::string& body) {
  return fmt::format("<details><summary>{}</summary>\n{}</details>\n", escaped(title), body);
}

std::string page_head(const std::string& title, const std::string& what) {
  constexpr const char* kPolicy =
      "default-src 'none'; img-src data: blob:; style-src 'unsafe-inline'; script-src "
      "'unsafe-inline'";
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<link rel=\"icon\" href=\"data:,\">\n"
      "<title>{} - condyle</title>\n<style>\n{}</style>\n</head>\n<body>\n"
      "<header>\n<h1>{}</h1>\n<p>{}</p>\n</header>\n<main>\n",
      kPolicy, escaped(title), page_style(), escaped(title), escaped(what));
}

std::string page_foot() { return "</main>\n</body>\n</html>\n"; }

}  // namespace condyle
