/// Points of contact that come and go while the phantom's shank is struck.

#include "condyle/network/contact_detection.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

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

/// A ball of 10 mm on four springs, dropped; the floor is `floor` below where its lowest point starts.
Scene hanging_ball(double floor, const std::string& contact, const std::string& surface = "") {
  const auto spring = [](const char* name, const char* fixed, const char* moving) {
    return fmt::format(
        "[[ligament]]\nname = \"{}\"\nends = [{{ body = \"ground\", at = {} }}, {{ body = "
        "\"ball\", at = {} }}]\nlaw = \"quadratic\"\nstiffness = 1\nslack_length = 20\n",
        name, fixed, moving);
  };
  const std::string text =
      "title = \"hanging ball\"\n[units]\nlength = \"mm\"\nangle = \"deg\"\nforce = \"N\"\n"
      "[[body]]\nname = \"ground\"\nfixed = true\n"
      "[[body]]\nname = \"ball\"\nmass = 1\ncenter = [0, 0, 0]\n"
      "inertia = [[100, 0, 0], [0, 100, 0], [0, 0, 100]]\nstart.translation = [0, 0, 10]\n"
      "[[surface]]\nname = \"floor\"\nbody = \"ground\"\nkind = \"plane\"\n" +
      fmt::format("point = [0, 0, {}]\nnormal = [0, 0, 1]\n", -floor) + surface +
      "[[surface]]\nname = \"ball\"\nbody = \"ball\"\nkind = \"sphere\"\ncenter = [0, 0, 0]\n"
      "radius = 10\n" +
      surface + "[[contact]]\nname = \"c\"\nsurfaces = [\"floor\", \"ball\"]\n" + contact +
      spring("s1", "[30, 0, -5]", "[0, 0, -2]") + spring("s2", "[-30, 5, -5]", "[0, 3, -2]") +
      spring("s3", "[-5, -30, -5]", "[2, 0, -2]") + spring("s4", "[0, 30, -5]", "[2, 1, -3]") +
      "[simulate]\ntime = 0.02\nrate = 500\ngravity = [0, 0, -9810]\n";
  return parse_scene(text, "hanging.toml");
}

// Whatever a motion follows: an open contact is told where its gap is smallest, as in a sweep.
TEST(ContactDetection, AnOpenContactIsToldWhereItsGapIsSmallest) {
  const std::string elastic = "modulus = 10\npoisson = 0.45\nlayer = 3\n";
  const struct {
    double floor;
    Scene scene;
  } cases[] = {{0, hanging_ball(0, "state = \"open\"\n")},
               {150, hanging_ball(150, "state = \"auto\"\n")},
               {150, hanging_ball(150, "law = \"layer\"\n", elastic)}};
  for (const auto& [floor, scene] : cases) {
    const Simulation simulation = simulate(scene, fit_surfaces(scene));
    ASSERT_TRUE(simulation.motion.completed) << simulation.motion.reason;
    ASSERT_EQ(simulation.poses.size(), 11U);
    for (const PoseResult& pose : simulation.poses) {
      ASSERT_EQ(pose.contacts[0].points.size(), 1U);
      const double gap = pose.X_BA.p.z() - 10 + floor;
      EXPECT_NEAR(pose.contacts[0].points[0].gap, gap, 1e-9) << pose.value << " s";
      EXPECT_EQ(
          pose.remark,
          gap < -1e-3 ? fmt::format("contact \"c\", held open, overlaps by {:.2g} mm", -gap) : "");
    }
  }
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
