#include "condyle/report/scene_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "condyle/scene_file/document.h"

namespace condyle {
namespace {

/// A value that is no table, and no list of more than short rows of numbers, with its place.
struct SceneEntry {
  std::string where, what;
  const Value* value = nullptr;
};

bool is_leaf(const Value& value) {
  constexpr std::size_t kLongestLeaf = 4;
  if (value.type == Value::Type::kTable) return false;
  if (value.type != Value::Type::kArray) return true;
  return value.items.size() <= kLongestLeaf &&
         std::all_of(value.items.begin(), value.items.end(), [](const Value& item) {
           return item.type != Value::Type::kArray && item.type != Value::Type::kTable;
         });
}

void add_entries(const std::string& where,
                 const std::string& what,
                 const Value& value,
                 std::vector<SceneEntry>& entries) {
  if (is_leaf(value)) {
    entries.push_back({where, what, &value});
    return;
  }
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    const bool table = !value.keys.empty();
    const std::string item = table ? (what.empty() ? "" : what + ".") + value.keys[i]
                                   : fmt::format("{}[{}]", what, i + 1);
    add_entries(where, item, value.items[i], entries);
  }
}

/// "ligament aACL", or "drive 2" of those without a name.
std::string label_of(const std::string& key, const Value& item, std::size_t index) {
  const Value* name = item.find("name");
  if (name != nullptr && name->type == Value::Type::kText) return key + " " + name->text;
  return fmt::format("{} {}", key, index + 1);
}

bool is_list_of_tables(const Value& value) {
  return value.type == Value::Type::kArray && !value.items.empty() &&
         std::all_of(value.items.begin(), value.items.end(),
                     [](const Value& item) { return item.type == Value::Type::kTable; });
}

std::vector<SceneEntry> entries_of(const Value& document) {
  std::vector<SceneEntry> entries;
  for (std::size_t i = 0; i < document.items.size(); ++i) {
    const std::string& key = document.keys[i];
    const Value& value = document.items[i];
    if (is_list_of_tables(value)) {
      for (std::size_t k = 0; k < value.items.size(); ++k)
        add_entries(label_of(key, value.items[k], k), "", value.items[k], entries);
    } else if (value.type == Value::Type::kTable) {
      add_entries(key, "", value, entries);
    } else {
      add_entries("", key, value, entries);
    }
  }
  return entries;
}

bool same(const Value& a, const Value& b) {
  if (a.is_number() && b.is_number())
    return a.number == b.number || (std::isnan(a.number) && std::isnan(b.number));
  return a.type == b.type && a.boolean == b.boolean && a.text == b.text &&
         std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), same);
}

using Key = std::pair<std::string, std::string>;  // where, what
using Found = std::vector<const Value*>;          // by scene; null where it has none

/// Entries of all scenes by their places, and the places in the order in which they come first.
struct AllEntries {
  std::vector<Key> order;
  std::map<Key, Found> values;
  std::map<std::string, std::vector<bool>> tables;  ///< which scenes have one of that name
};

AllEntries all_entries(const std::vector<Value>& documents) {
  AllEntries all;
  for (std::size_t s = 0; s < documents.size(); ++s) {
    for (const SceneEntry& entry : entries_of(documents[s])) {
      const auto [place, fresh] =
          all.values.try_emplace({entry.where, entry.what}, Found(documents.size()));
      if (fresh) all.order.push_back(place->first);
      place->second[s] = entry.value;
      auto [table, unknown] = all.tables.try_emplace(entry.where, documents.size());
      table->second[s] = true;
    }
  }
  return all;
}

bool all_same(const Found& found) {
  return std::all_of(found.begin(), found.end(), [&](const Value* value) {
    return value != nullptr && found.front() != nullptr && same(*value, *found.front());
  });
}

SceneDifference difference_of(const Key& key, const Found& found) {
  SceneDifference difference{key.first, key.second, {}, {}};
  for (const Value* value : found)
    difference.values.push_back(value == nullptr ? std::nullopt : std::optional(to_text(*value)));
  const auto is_number = [](const Value* value) { return value != nullptr && value->is_number(); };
  if (std::all_of(found.begin(), found.end(), is_number))
    for (const Value* value : found) difference.numbers.push_back(value->number);
  return difference;
}

/// Of a table that some scenes do not have: who has it.
SceneDifference whole_table(const std::string& where, const std::vector<bool>& there) {
  SceneDifference difference{where, "", {}, {}};
  for (const bool has : there)
    difference.values.push_back(has ? std::optional<std::string>("there") : std::nullopt);
  return difference;
}

}  // namespace

std::vector<SceneDifference> scene_differences(const std::vector<std::string>& texts) {
  std::vector<Value> documents;
  for (const std::string& text : texts) documents.push_back(parse_document(text, "scene"));
  const AllEntries all = all_entries(documents);
  std::vector<SceneDifference> differences;
  std::map<std::string, bool> told;
  for (const Key& key : all.order) {
    const std::vector<bool>& there = all.tables.at(key.first);
    if (std::find(there.begin(), there.end(), false) != there.end() && !key.first.empty()) {
      if (!told[key.first]) differences.push_back(whole_table(key.first, there));
      told[key.first] = true;
    } else if (const Found& found = all.values.at(key); !all_same(found)) {
      differences.push_back(difference_of(key, found));
    }
  }
  return differences;
}

std::string value_beside_first(const SceneDifference& difference, std::size_t scene) {
  if (!difference.values.at(scene)) return "-";
  const std::string& text = *difference.values[scene];
  if (scene == 0 || difference.numbers.empty() || difference.numbers[0] == 0) return text;
  const double first = difference.numbers[0], here = difference.numbers[scene];
  const double percent = 100 * (here - first) / std::abs(first);
  if (!std::isfinite(percent) || here == first || std::abs(percent) >= 1000) return text;
  return fmt::format("{} ({:+.3g} %)", text, percent);
}

}  // namespace condyle
