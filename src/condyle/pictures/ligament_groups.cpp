#include "condyle/pictures/ligament_groups.h"

namespace condyle {

std::vector<LigamentBundle> ligament_groups(const Scene& scene) {
  std::vector<std::string> names;
  for (const LigamentDescription& ligament : scene.ligaments) names.push_back(ligament.name);
  std::vector<LigamentBundle> bundles = ligament_bundles(names);
  for (LigamentBundle& bundle : bundles) {
    if (bundle.members.size() == 1) bundle.name = names[bundle.members.front()];
  }
  return bundles;
}

}  // namespace condyle
