#pragma once

/// The numbers of a result in memory, under the names that a result file has for them: what a file says, without a
/// file. Filled by the same functions that write one (Hdf5Group), so that there is one table of names and units.

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace condyle {

/// A dataset: values with the last index fastest.
struct DataColumn {
  using Values = std::variant<std::vector<double>, std::vector<int>, std::vector<std::string>>;
  Values values;
  std::vector<std::size_t> shape;
  std::string units;
  std::map<std::string, std::vector<std::string>> attributes = {};
};

struct ColumnTree {
  /// In the order in which they were made; a group or a column each.
  std::vector<std::string> names;
  std::map<std::string, std::unique_ptr<ColumnTree>> groups;
  std::map<std::string, DataColumn> columns;
  std::map<std::string, std::string> attributes;

  /// Null where there is none of that name.
  [[nodiscard]] const ColumnTree* group(const std::string& name) const {
    const auto at = groups.find(name);
    return at == groups.end() ? nullptr : at->second.get();
  }
  [[nodiscard]] const DataColumn* column(const std::string& name) const {
    const auto at = columns.find(name);
    return at == columns.end() ? nullptr : &at->second;
  }
  /// A new group, or the one of that name.
  ColumnTree& make_group(const std::string& name) {
    std::unique_ptr<ColumnTree>& place = groups[name];
    if (!place) {
      place = std::make_unique<ColumnTree>();
      names.push_back(name);
    }
    return *place;
  }
  DataColumn& add(const std::string& name, DataColumn column) {
    names.push_back(name);
    return columns[name] = std::move(column);
  }
};

}  // namespace condyle
