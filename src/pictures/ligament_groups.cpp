#include "pictures/ligament_groups.h"

#include <map>

namespace condyle {
namespace {

std::string without_number(const std::string& name) {
  const std::size_t last = name.find_last_not_of("0123456789");
  return last == std::string::npos ? name : name.substr(0, last + 1);
}

}  // namespace

std::vector<LigamentGroup> ligament_groups(const Scene& scene) {
  std::vector<LigamentGroup> groups;
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const auto [found, fresh] =
        place.emplace(without_number(scene.ligaments[i].name), groups.size());
    if (fresh) groups.push_back({found->first, {}});
    groups[found->second].strands.push_back(i);
  }
  for (LigamentGroup& group : groups) {
    if (group.strands.size() == 1) group.name = scene.ligaments[group.strands.front()].name;
  }
  return groups;
}

}  // namespace condyle
