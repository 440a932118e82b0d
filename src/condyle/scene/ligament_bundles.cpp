#include "condyle/scene/ligament_bundles.h"

#include <algorithm>
#include <cctype>

namespace condyle {
namespace {

std::string without_number(std::string name) {
  while (name.size() > 1 && std::isdigit(static_cast<unsigned char>(name.back())) != 0)
    name.pop_back();
  return name;
}

// Small letters at the end, as long as capitals stand before them.
std::string without_part(const std::string& name) {
  std::string stem = without_number(name);
  while (!stem.empty() && std::islower(static_cast<unsigned char>(stem.back())) != 0)
    stem.pop_back();
  return stem.size() > 1 ? stem : without_number(name);
}

std::vector<LigamentBundle> group_by(const std::vector<std::string>& names,
                                     std::string (*key)(const std::string&)) {
  std::vector<LigamentBundle> groups;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string name = key(names[i]);
    const auto same = [&](const LigamentBundle& group) { return group.name == name; };
    auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) group = groups.insert(groups.end(), {name, {}});
    group->members.push_back(i);
  }
  return groups;
}

}  // namespace

std::vector<LigamentBundle> ligament_bundles(const std::vector<std::string>& names) {
  return group_by(names, [](const std::string& name) { return without_number(name); });
}

std::vector<LigamentBundle> ligament_columns(const std::vector<std::string>& names,
                                             std::size_t most) {
  if (names.size() <= most) return group_by(names, [](const std::string& name) { return name; });
  std::vector<LigamentBundle> bundles = ligament_bundles(names);
  return bundles.size() <= most ? bundles : group_by(names, without_part);
}

}  // namespace condyle
