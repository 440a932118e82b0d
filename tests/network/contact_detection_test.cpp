/// Points of contact that come and go while the phantom's shank is struck.

#include "condyle/network/contact_detection.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/model_covers.h"
#include "condyle/network/simulate.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle {
namespace {

const char* const kScene = CONDYLE_SOURCE_DIR "/data/phantom/blow.toml";

// 80 N for 50 ms: the compartments lift, strike in turn and touch in places that no contact
// followed at the start. At every frame the lowest gap anywhere between the surfaces is searched
// for afresh.
TEST(ContactDetection, NoBlowDrivesTheBodiesIntoEachOther) {
  Scene scene = read_scene(kScene);
  scene.loads.back().vector *= 1.6;
  scene.simulation->drives.front().duration = 0.05;
  scene.simulation->tolerance = 1e-7;
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const Simulation simulation = simulate(scene, surfaces);
  ASSERT_TRUE(simulation.motion.completed) << simulation.motion.reason;
  const Model model = build_model(scene, surfaces);
  std::vector<ContactSearch> searches(model.pairs.begin(), model.pairs.end());
  std::vector<GapMinimum> minima;
  int opened = 0;
  for (const PoseResult& pose : simulation.poses) {
    for (std::size_t p = 0; p < searches.size(); ++p) {
      opened += pose.contacts[p].closed ? 0 : 1;
      searches[p].find(model.origins.into_model(pose.X_BA), 0, minima);
      for (const GapMinimum& minimum : minima)
        EXPECT_GT(minimum.refined ? minimum.gap : 0, -1e-5) << pose.value << " s";
    }
  }
  EXPECT_GT(opened, 5);
}

// At rest on both compartments: each pair has one closed contact and the others wait.
TEST(ContactDetection, FollowsAnUnseenPlaceAndDropsADouble) {
  const Scene scene = read_scene(kScene);
  const std::vector<FittedSurface> surfaces = fit_surfaces(scene);
  const Model model = build_model(scene, surfaces);
  const KneeNetwork knee = make_knee_network(model, std::nullopt);
  ASSERT_EQ(knee.places.size(), 2 * static_cast<std::size_t>(kPointsPerPair));
  NetworkState state;
  state.bodies.resize(1);
  state.bodies[0].X = model.start;
  state.contacts.resize(knee.places.size());
  for (MovingContact& contact : state.contacts) contact.followed = false;
  KneeContactDetection detect(model, cover_pairs(model), knee);

  EXPECT_TRUE(detect(state).overlapping.empty());
  const auto followed = [&] {
    return std::count_if(state.contacts.begin(), state.contacts.end(),
                         [](const MovingContact& contact) { return contact.followed; });
  };
  const auto places = followed();
  ASSERT_GE(places, 2);
  EXPECT_EQ(detect(state).unseen, std::numeric_limits<double>::infinity());
  EXPECT_EQ(followed(), places);

  const auto waiting = std::find_if(state.contacts.begin(), state.contacts.end(),
                                    [](const MovingContact& c) { return !c.followed; });
  ASSERT_NE(waiting, state.contacts.end());
  const std::size_t pair_first =
      static_cast<std::size_t>(waiting - state.contacts.begin()) / kPointsPerPair * kPointsPerPair;
  *waiting = state.contacts[pair_first];
  (void)detect(state);
  EXPECT_EQ(followed(), places);
}

}  // namespace
}  // namespace condyle
