#include <algorithm>

#include "condyle/scene/usable_number.h"
#include "condyle/scene_file/read_sections.h"

namespace condyle {

int flexion_condition(const Scene& scene) {
  for (std::size_t i = 0; i < scene.conditions.size(); ++i) {
    if (scene.conditions[i].kind == ConditionKind::kFlexion) return static_cast<int>(i);
  }
  return -1;
}

void read_laxity(const Section& root, Scene& scene) {
  if (!root.has("laxity")) return;
  const Section section = root.table("laxity", "a table [laxity] with flexion and cut");
  if (!scene.sweep || !scene.sweep->varies_load)
    section.fail_with("needs a [sweep] with vary = \"NAME.scale\", the load that pulls");
  LaxityDescription laxity;
  laxity.flexions = section.numbers("flexion", "angles [f1, f2, ...]");
  std::vector<double> sorted = laxity.flexions;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    section.fail("flexion", "each angle once");
  for (double& flexion : laxity.flexions) flexion *= scene.angle_to_rad;
  if (!std::all_of(laxity.flexions.begin(), laxity.flexions.end(), is_usable_angle))
    section.fail("flexion", "angles of at most one turn (suspect [units] angle)");
  laxity.condition = flexion_condition(scene);
  if (laxity.condition < 0)
    section.fail("flexion", "a [[condition]] of kind \"flexion\" that holds it");
  if (section.has("cut")) {
    const std::string expected = "names of ligaments [\"aACL\", ...]";
    const Value& cut = section.value("cut", expected);
    if (cut.type != Value::Type::kArray) section.fail("cut", expected);
    for (const Value& name : cut.items) {
      const int index =
          section.reference("cut", name, "the name of a ligament", names_of(scene.ligaments));
      if (std::find(laxity.cut.begin(), laxity.cut.end(), index) != laxity.cut.end())
        section.fail("cut", name, "each ligament once");
      laxity.cut.push_back(index);
    }
  }
  section.finish();
  scene.laxity = laxity;
}

}  // namespace condyle
