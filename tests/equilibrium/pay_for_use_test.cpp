/// Model only what a scene needs: what a scene does without costs it nothing. Counted in
/// allocations, in questions to surfaces and elements, and in machine instructions, never in
/// seconds. tools/accuracy.sh prints the figures.

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "support/allocation_count.h"
#include "support/counted_model.h"
#include "support/instruction_count.h"
#include "support/part_scenes.h"

namespace condyle::accuracy {

void PrintTo(const PartScene& scene, std::ostream* out) { *out << scene.name; }

namespace {

constexpr int kVisits = 2 * PartSweep::kPoses;
constexpr int kMiddle = PartSweep::kPoses / 2;

test::Asked asked_in_sweep(const Parts& parts) {
  test::Asked asked;
  const PartSweep plain(parts);
  PartSweep sweep(plain, test::counted(plain.model(), asked));
  PoseResult pose;
  sweep.solve(0, pose);
  sweep.there_and_back(pose);
  asked = {};
  EXPECT_EQ(sweep.there_and_back(pose), kVisits);
  return asked;
}

/// Of the pose in the middle, coming from the one before.
std::optional<long> instructions_of_pose(const Parts& parts) {
  PartSweep sweep(parts);
  PoseResult pose;
  sweep.solve(0, pose);
  sweep.there_and_back(pose);
  for (int k = 1; k < kMiddle; ++k) sweep.solve(k, pose);
  return test::count_instructions([&] { sweep.solve(kMiddle, pose); });
}

class PartScenes : public testing::TestWithParam<PartScene> {};

TEST_P(PartScenes, WarmPosesAllocateNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "allocations are not counted here";
  PartSweep sweep(GetParam().parts);
  PoseResult pose;
  sweep.solve(0, pose);
  sweep.there_and_back(pose);
  const test::AllocationCount count;
  const test::HeapUse heap;
  EXPECT_EQ(sweep.there_and_back(pose), kVisits);
  EXPECT_EQ(count.since_start(), 0);
  EXPECT_EQ(heap.peak(), 0);
}

std::string name_of(const testing::TestParamInfo<PartScene>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Each, PartScenes, testing::ValuesIn(part_scenes()), name_of);

/// Those that do without something that another one has.
std::vector<PartScene> poorer_scenes() {
  std::vector<PartScene> poorer;
  for (const PartScene& scene : part_scenes())
    if (!scene.more.empty()) poorer.push_back(scene);
  return poorer;
}

class PoorerScenes : public testing::TestWithParam<PartScene> {};

TEST_P(PoorerScenes, AskNoMoreOfSurfacesAndElements) {
  const test::Asked less = asked_in_sweep(GetParam().parts);
  const test::Asked all = asked_in_sweep(part_scene(GetParam().more).parts);
  EXPECT_LE(less.surfaces, all.surfaces);
  EXPECT_LE(less.elements, all.elements);
}

INSTANTIATE_TEST_SUITE_P(Each, PoorerScenes, testing::ValuesIn(poorer_scenes()), name_of);

// Each scene is counted once: every instruction is a stop of its own.
TEST(PayForUse, PoorerScenesTakeFewerInstructions) {
  std::map<std::string, long> instructions;
  for (const PartScene& scene : part_scenes()) {
    const std::optional<long> count = instructions_of_pose(scene.parts);
    if (!count) GTEST_SKIP() << "instructions cannot be counted here";
    EXPECT_GT(*count, 0) << scene.name;
    instructions[scene.name] = *count;
  }
  for (const PartScene& scene : poorer_scenes())
    EXPECT_LT(instructions.at(scene.name), instructions.at(scene.more))
        << scene.name << " beside " << scene.more;
}

TEST(PayForUse, WithoutLigamentsNoElementIsAsked) {
  EXPECT_EQ(asked_in_sweep(part_scene("ligaments").parts).elements, 0);
  EXPECT_GT(asked_in_sweep(part_scene("prescribed").parts).elements, 0);
}

// Neither is a question to a surface or an element: they work on what Newton has left.
TEST(PayForUse, JointCoordinatesAndStabilityAskNothingOfSurfacesAndElements) {
  const test::Asked all = asked_in_sweep(part_scene("all").parts);
  for (const char* name : {"joint", "stability"}) {
    const test::Asked less = asked_in_sweep(part_scene(name).parts);
    EXPECT_EQ(less.surfaces, all.surfaces) << name;
    EXPECT_EQ(less.elements, all.elements) << name;
  }
}

// Newton asks both surfaces of both contacts once for each iteration and at the end, and each
// element as often, and once more to tell its force.
TEST(PayForUse, AHeldContactIsAskedByNewtonAlone) {
  test::Asked asked;
  const PartSweep plain(part_scene("search").parts);
  PartSweep sweep(plain, test::counted(plain.model(), asked));
  PoseResult pose;
  sweep.solve(0, pose);
  sweep.there_and_back(pose);
  for (int k = 1; k <= PartSweep::kPoses; ++k) {
    asked = {};
    sweep.solve(k, pose);
    const long assemblies = pose.iterations + 1;
    const auto elements = static_cast<long>(plain.model().elements.size());
    EXPECT_EQ(asked.surfaces, 4 * assemblies);
    EXPECT_EQ(asked.elements, elements * (assemblies + 1));
  }
}

}  // namespace
}  // namespace condyle::accuracy
