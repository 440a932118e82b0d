#include "condyle/scene_file/document.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "condyle/input_error.h"

namespace condyle {
namespace {

Value convert(const toml::node& node, int line_of_parent);

void convert_items(const toml::array& array, Value& value) {
  value.type = Value::Type::kArray;
  for (const toml::node& item : array) value.items.push_back(convert(item, value.line));
}

bool stands_before(const toml::key& a, const toml::key& b) {
  const toml::source_position &p = a.source().begin, &q = b.source().begin;
  return p.line != q.line ? p.line < q.line : p.column < q.column;
}

// In the order of the file; toml++ keeps keys in the order of the alphabet.
void convert_entries(const toml::table& table, Value& value) {
  value.type = Value::Type::kTable;
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (const auto& [key, item] : table) entries.emplace_back(&key, &item);
  std::stable_sort(entries.begin(), entries.end(),
                   [](const auto& a, const auto& b) { return stands_before(*a.first, *b.first); });
  for (const auto& [key, item] : entries) {
    value.keys.emplace_back(key->str());
    value.items.push_back(convert(*item, value.line));
  }
}

// What has no place of its own takes that of its parent.
int line_of(const toml::node& node, int line_of_parent) {
  const auto line = static_cast<int>(node.source().begin.line);
  return line > 0 ? line : line_of_parent;
}

Value convert(const toml::node& node, int line_of_parent) {
  Value value;
  value.line = line_of(node, line_of_parent);
  value.column = static_cast<int>(node.source().begin.column);
  value.end = static_cast<int>(node.source().end.column);
  if (const toml::table* table = node.as_table()) {
    convert_entries(*table, value);
  } else if (const toml::array* array = node.as_array()) {
    convert_items(*array, value);
  } else if (const auto* text = node.as_string()) {
    value.type = Value::Type::kText;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.type = Value::Type::kInteger;
    value.number = static_cast<double>(integer->get());
  } else if (const auto* number = node.as_floating_point()) {
    value.type = Value::Type::kNumber;
    value.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    value.type = Value::Type::kBoolean;
    value.boolean = boolean->get();
  } else {
    value.type = Value::Type::kDate;
  }
  return value;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '\n')
      out += "\\n";
    else if (c == '"')
      out += "\\\"";
    else if (static_cast<unsigned char>(c) < 0x20)
      out += '?';
    else
      out += c;
  }
  return out + "\"";
}

std::string joined(const Value& value, const char* open, const char* close) {
  std::string out = open;
  for (std::size_t i = 0; i < value.items.size() && out.size() < 100; ++i) {
    if (i > 0) out += ", ";
    if (!value.keys.empty()) out += value.keys[i] + " = ";
    out += to_text(value.items[i]);
  }
  return out + close;
}

std::string shortened(std::string text) {
  constexpr std::size_t kLongest = 80;
  if (text.size() <= kLongest) return text;
  std::size_t end = kLongest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

/// Where a comment or a quoted text that begins at `i` ends: at its last character; `i` where none begins.
std::size_t end_of_words(const std::string& text, std::size_t i) {
  const char c = text[i];
  if (c == '#') return std::min(text.find('\n', i), text.size()) - 1;
  if (c != '"' && c != '\'') return i;
  const std::string three(3, c);
  const bool long_text = text.compare(i, 3, three) == 0;
  for (std::size_t k = i + (long_text ? 3 : 1); k < text.size(); ++k) {
    if (c == '"' && text[k] == '\\') {
      ++k;
    } else if (!long_text && (text[k] == c || text[k] == '\n')) {
      return k;
    } else if (long_text && text.compare(k, 3, three) == 0) {
      k += 2;  // one or two more quotes may be its last characters
      for (int more = 0; more < 2 && k + 1 < text.size() && text[k + 1] == c; ++more) ++k;
      return k;
    }
  }
  return text.size() - 1;
}

/// toml++ bounds the depth of values but not that of keys, and whatever visits a tree as deep as a.a.a... runs
/// out of stack.
void check_key_depth(const std::string& text, const std::string& file) {
  constexpr int kMostParts = 256;
  int line = 1, dots = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t end = end_of_words(text, i);
    line += static_cast<int>(std::ranges::count(std::string_view(text).substr(i, end - i), '\n'));
    i = end;
    if (text[i] == '\n') ++line;
    if (std::string_view("\n,=[]{}").find(text[i]) != std::string_view::npos) dots = 0;
    if (text[i] == '.' && i + 1 < text.size() && text[i + 1] != '.') ++dots;
    if (dots >= kMostParts)
      throw InputError(
          fmt::format("{}:{}: not valid TOML: a key of more than {} parts, expected fewer", file,
                      line, kMostParts));
  }
}

}  // namespace

const Value* Value::find(const std::string& key) const {
  const auto found = std::find(keys.begin(), keys.end(), key);
  return found == keys.end() ? nullptr : &items[static_cast<std::size_t>(found - keys.begin())];
}

Value parse_document(const std::string& text, const std::string& file) {
  check_key_depth(text, file);
  try {
    return convert(toml::parse(text), 1);
  } catch (const toml::parse_error& error) {
    std::string what(error.description());
    std::replace(what.begin(), what.end(), '\n', ' ');
    throw InputError(
        fmt::format("{}:{}: not valid TOML: {}", file, error.source().begin.line, what));
  }
}

std::string to_text(const Value& value) {
  switch (value.type) {
    case Value::Type::kBoolean:
      return value.boolean ? "true" : "false";
    case Value::Type::kInteger:
    case Value::Type::kNumber:
      return fmt::format("{}", value.number);
    case Value::Type::kText:
      return shortened(quoted(value.text));
    case Value::Type::kArray:
      return shortened(joined(value, "[", "]"));
    case Value::Type::kTable:
      return shortened(joined(value, "{ ", " }"));
    case Value::Type::kDate:
      break;
  }
  return "a date or time";
}

}  // namespace condyle
