#include "condyle/scene_file/section.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "condyle/input_error.h"
#include "condyle/scene/usable_number.h"

namespace condyle {
namespace {

const char* suffix(Range range) {
  switch (range) {
    case Range::kNotNegative:
      return " >= 0";
    case Range::kPositive:
      return " > 0";
    case Range::kAny:
      break;
  }
  return "";
}

bool within(double number, Range range) {
  if (!is_usable(number)) return false;
  return range == Range::kAny || number > 0 || (range == Range::kNotNegative && number == 0);
}

// Number of letters to insert, drop or replace to get from a to b.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = std::max<std::size_t>(1, std::min<std::size_t>(3, word.size() / 2)) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least && distance < candidate.size()) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 12;
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) {
    if (i > 0) out += i + 1 == names.size() ? " or " : ", ";
    out += '"' + names[i] + '"';
  }
  return names.size() > kMost ? out + fmt::format(" or one of {} more", names.size() - kMost) : out;
}

Section::Section(const Value& table, const Source& source, std::string label, std::string prefix)
    : table_(&table), source_(&source), label_(std::move(label)), prefix_(std::move(prefix)) {}

const Value* Section::find(const std::string& key) const {
  known_.insert(key);
  return table_->find(key);
}

const Value& Section::value(const std::string& key, const std::string& expected) const {
  const Value* found = find(key);
  if (found == nullptr) fail_missing(key, expected);
  return *found;
}

std::string Section::text(const std::string& key, const std::string& expected) const {
  const Value& found = value(key, expected);
  if (found.type != Value::Type::kText || found.text.empty())
    fail(key, found, expected + ", a text in quotes");
  return found.text;
}

bool Section::boolean(const std::string& key) const {
  const Value& found = value(key, "true or false");
  if (found.type != Value::Type::kBoolean) fail(key, found, "true or false");
  return found.boolean;
}

double Section::checked(const std::string& key,
                        const Value& value,
                        const std::string& expected,
                        Range range) const {
  if (!value.is_number() || !within(value.number, range)) {
    const bool plain = value.is_number() && is_usable(value.number);
    const char* finite = value.is_number() && std::isfinite(value.number) ? ", a number below 1e100"
                                                                          : ", a finite number";
    fail(key, value, expected + suffix(range) + (plain ? "" : finite));
  }
  return value.number;
}

double Section::number(const std::string& key, const std::string& expected, Range range) const {
  return checked(key, value(key, expected + suffix(range)), expected, range);
}

double Section::number_or(const std::string& key,
                          double otherwise,
                          const std::string& expected,
                          Range range) const {
  return has(key) ? number(key, expected, range) : otherwise;
}

std::vector<double> Section::numbers(const std::string& key, const std::string& expected) const {
  const Value& list = value(key, expected);
  if (list.type != Value::Type::kArray || list.items.empty()) fail(key, list, expected);
  std::vector<double> out;
  for (const Value& item : list.items) out.push_back(checked(key, item, expected, Range::kAny));
  return out;
}

Eigen::Vector3d Section::vector_of(const std::string& key,
                                   const Value& value,
                                   const std::string& expected) const {
  const bool fits = value.type == Value::Type::kArray && value.items.size() == 3 &&
                    std::all_of(value.items.begin(), value.items.end(), [](const Value& item) {
                      return item.is_number() && is_usable(item.number);
                    });
  if (!fits) fail(key, value, expected + " [x, y, z], three finite numbers");
  return {value.items[0].number, value.items[1].number, value.items[2].number};
}

Eigen::Vector3d Section::vector(const std::string& key, const std::string& expected) const {
  return vector_of(key, value(key, expected + " [x, y, z]"), expected);
}

std::vector<Eigen::Vector3d> Section::vectors(const std::string& key,
                                              const std::string& expected) const {
  const Value& list = value(key, expected);
  if (list.type != Value::Type::kArray) fail(key, list, expected);
  std::vector<Eigen::Vector3d> out;
  for (const Value& item : list.items) out.push_back(vector_of(key, item, expected + ", each"));
  return out;
}

Section Section::table(const std::string& key, const std::string& expected) const {
  const Value& found = value(key, expected);
  if (found.type != Value::Type::kTable) fail(key, found, expected);
  if (label_.empty()) return {found, *source_, "[" + key + "]"};
  return {found, *source_, label_, prefix_ + key + "."};
}

std::vector<Section> Section::tables(const std::string& key, const std::string& expected) const {
  const Value& list = value(key, expected);
  if (list.type != Value::Type::kArray) fail(key, list, expected);
  std::vector<Section> out;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    if (list.items[i].type != Value::Type::kTable) fail(key, list.items[i], expected);
    out.emplace_back(list.items[i], *source_, label_, fmt::format("{}{}[{}].", prefix_, key, i));
  }
  return out;
}

std::vector<Section> Section::sections(const std::string& key) const {
  std::vector<Section> out;
  const Value* list = find(key);
  if (list == nullptr) return out;
  const bool tables = list->type == Value::Type::kArray &&
                      std::all_of(list->items.begin(), list->items.end(), [](const Value& item) {
                        return item.type == Value::Type::kTable;
                      });
  const std::string heading =
      label_.empty() ? key : label_.substr(1, label_.size() - 2) + "." + key;
  if (!tables) fail_at(list->line, fmt::format("{}, expected tables headed [[{}]]", key, heading));
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    const Value* name = list->items[i].find("name");
    const bool named = name != nullptr && name->type == Value::Type::kText && !name->text.empty();
    out.emplace_back(list->items[i], *source_,
                     fmt::format("[[{}]] {}", heading,
                                 named ? to_text(*name) : fmt::format("number {}", i + 1)));
  }
  return out;
}

int Section::reference(const std::string& key,
                       const std::string& what,
                       const std::vector<std::string>& names) const {
  return reference(key, value(key, what.empty() ? listed(names) : what), what, names);
}

int Section::reference(const std::string& key,
                       const Value& name,
                       const std::string& what,
                       const std::vector<std::string>& names) const {
  const auto found = std::find(names.begin(), names.end(), name.text);
  if (name.type == Value::Type::kText && found != names.end())
    return static_cast<int>(found - names.begin());
  std::string expected =
      what.empty() ? listed(names) : what + (names.empty() ? "" : ": " + listed(names));
  const std::string meant = nearest(name.text, names);
  if (!meant.empty()) expected += fmt::format("; did you mean \"{}\"?", meant);
  fail(key, name, expected);
}

std::string Section::place_at(int line) const {
  return fmt::format("{}:{}: {}", source_->file, line, label_.empty() ? "" : label_ + ": ");
}

std::string Section::place(const std::string& key) const {
  return fmt::format("{}{}{}", place_at(table_->find(key)->line), prefix_, key);
}

void Section::fail_at(int line, const std::string& message) const {
  throw InputError(place_at(line) + message);
}

void Section::fail(const std::string& key, const Value& value, const std::string& expected) const {
  fail_at(value.line,
          fmt::format("{}{} = {}, expected {}", prefix_, key, to_text(value), expected));
}

void Section::fail(const std::string& key, const std::string& expected) const {
  const Value* found = table_->find(key);
  if (found == nullptr) fail_missing(key, expected);
  fail(key, *found, expected);
}

void Section::fail_with(const std::string& message) const { fail_at(table_->line, message); }

namespace {

/// A key of the file that stands below the head of one of its tables, and so belongs to that; null where there is none.
const Value* misplaced(const Value& root, const std::string& key) {
  for (const Value& item : root.items) {
    if (const Value* found = item.find(key)) return found;
    for (const Value& table : item.items)
      if (const Value* found = table.find(key)) return found;
  }
  return nullptr;
}

}  // namespace

// A missing key is often one that stands there misspelt, or in another table.
void Section::fail_missing(const std::string& key, const std::string& expected) const {
  std::vector<std::string> strangers;
  for (const std::string& present : table_->keys) {
    if (!known_.contains(present)) strangers.push_back(present);
  }
  const std::string meant = nearest(key, strangers);
  if (!meant.empty()) {
    fail_at(table_->find(meant)->line,
            fmt::format("unknown key {}{} = {}, did you mean \"{}\"?", prefix_, meant,
                        to_text(*table_->find(meant)), key));
  }
  if (const Value* found = label_.empty() ? misplaced(*table_, key) : nullptr)
    fail_at(
        found->line,
        fmt::format(
            "{} = {} belongs to the table above it, expected before the first table of the file",
            key, to_text(*found)));
  fail_at(table_->line, fmt::format("{}{} is missing, expected {}", prefix_, key, expected));
}

void Section::fail_unknown(const std::string& key, const Value& value) const {
  const std::vector<std::string> known(known_.begin(), known_.end());
  const std::string meant = nearest(key, known);
  const std::string advice = meant.empty() ? "expected one of " + listed(known)
                                           : fmt::format("did you mean \"{}\"?", meant);
  fail_at(value.line,
          fmt::format("unknown key {}{} = {}, {}", prefix_, key, to_text(value), advice));
}

void Section::finish() const {
  for (const std::string& key : table_->keys) {
    if (!known_.contains(key)) fail_unknown(key, *table_->find(key));
  }
}

}  // namespace condyle
