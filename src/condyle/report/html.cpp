#include "condyle/report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/control_characters.h"
#include "condyle/report/embedded.h"

namespace condyle {

std::string escaped(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (const unsigned mark = turning_mark(text, at)) {
      out += fmt::format("\\u{:04x}", mark);
      at += 2;
      continue;
    }
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
      case '\n':
      case '\t':
        out += c;
        break;
      default:  // a page may hold no other control characters
        if (is_control(c))
          out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
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

std::string css_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte >= 0x80 || (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') ||
                       (c >= 'a' && c <= 'z') || c == ' ';
    out += plain ? std::string(1, c) : fmt::format("\\{:x} ", static_cast<unsigned>(byte));
  }
  return out + "\"";
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

namespace {

constexpr std::size_t kMostColumns = 16;  // more are wider than a page

/// The first column of a table and some others.
HtmlTable part_of(const HtmlTable& table, std::size_t begin, std::size_t end) {
  HtmlTable part;
  part.caption =
      fmt::format("{}{}columns {} to {} of {}", table.caption, table.caption.empty() ? "" : ", ",
                  begin + 1, end, table.columns.size());
  part.row_classes = table.row_classes;
  const auto taken = [&](const std::vector<std::string>& cells) {
    std::vector<std::string> some = {cells.front()};
    for (std::size_t k = begin; k < std::min(end, cells.size()); ++k) some.push_back(cells[k]);
    return some;
  };
  part.columns = taken(table.columns);
  for (const std::vector<std::string>& row : table.rows) part.rows.push_back(taken(row));
  part.text_columns.clear();
  for (const int column : table.text_columns) {
    const auto k = static_cast<std::size_t>(column);
    if (k == 0) part.text_columns.push_back(0);
    if (k >= begin && k < end) part.text_columns.push_back(static_cast<int>(k - begin + 1));
  }
  return part;
}

std::string in_parts(const HtmlTable& table) {
  std::string out;
  for (std::size_t begin = 1; begin < table.columns.size(); begin += kMostColumns - 1)
    out += html(part_of(table, begin, std::min(begin + kMostColumns - 1, table.columns.size())));
  return out;
}

}  // namespace

std::string html(const HtmlTable& table) {
  if (table.columns.size() > kMostColumns) return in_parts(table);
  const auto text_class = [&](std::size_t column) {
    const auto& list = table.text_columns;
    return std::find(list.begin(), list.end(), static_cast<int>(column)) == list.end()
               ? ""
               : " class=\"text\"";
  };
  constexpr std::size_t kLong = 30;  // rows; on paper it need not keep together
  std::string out =
      fmt::format("<div class=\"table{}\"><table>", table.rows.size() > kLong ? " long" : "");
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
      "<title>{} - condyle</title>\n<style>\n{}@page {{ @top-left {{ content: {}; font: 8pt "
      "sans-serif; color: #555; }} }}\n</style>\n</head>\n<body>\n"
      "<header>\n<h1>{}</h1>\n<p>{}</p>\n</header>\n<main>\n",
      kPolicy, escaped(title), page_style(), css_string(title), escaped(title), escaped(what));
}

std::string page_of(const std::vector<std::function<std::string()>>& parts,
                    const OnProgress& on_part) {
  std::string page;
  int done = 0;
  for (const auto& part : parts) {
    page += part();
    if (on_part) on_part(++done, static_cast<int>(parts.size()));
  }
  return page + "</main>\n</body>\n</html>\n";
}

}  // namespace condyle
