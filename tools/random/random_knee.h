#pragma once

/// A made-up joint: scene k is a function of a seed and of k. Two bodies whose surfaces face each other
/// across the plane z = 0, lines between them, loads and prescribed motions; then frames are turned and
/// moved, on some metres away, and all is written as a scene file in some units. Sound ones could be a
/// knee; each of the others has one ill.

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "condyle/scene/scene.h"
#include "condyle/surface/patch.h"
#include "random/draws.h"

namespace condyle::random_knees {

/// What carries between the bodies.
enum class Family { kNone, kExact, kPatches, kLayers, kLayeredPatches, kMixed };
inline constexpr int kFamilyCount = 6;

/// What is wrong with a scene.
enum class Ill {
  kNothing,
  kStiffness,   ///< from 1e-9 to 1e9 times what is usual
  kZeroLength,  ///< a line whose ends meet at the start pose
  kFarStart,    ///< 20 mm off
  kDeepStart,   ///< or 5 to 20 mm inside
  kAllSlack,
  kOutOfReach,  ///< surfaces 100 to 300 mm apart
  kPulledApart,
  kConforming,  ///< radii that agree to 1e-2 down to 0
  kTwice,       ///< a condition that stands there twice, or nearly so
  kTinyPatch,   ///< known parts of 1 to 4 mm
  kLoad         ///< forces and moments of any size
};
inline constexpr int kIllCount = 12;

struct RandomKnee {
  Family family = Family::kExact;
  Ill ill = Ill::kNothing;
  Scene scene;                                    ///< as it was made up, mm
  std::string text;                               ///< the same as a file
  std::vector<std::optional<PatchData>> patches;  ///< as Scene::surfaces
};

/// "patches, wraps", or the ill: the row of the table it counts in.
[[nodiscard]] std::string kind_of(const RandomKnee& knee);

[[nodiscard]] bool has_layers(const RandomKnee& knee);

[[nodiscard]] RandomKnee random_knee(std::uint64_t seed, std::uint64_t k);

// Its parts, in this order. Body 0 is the lower one (tibia), body 1 the upper one (femur); all in frames
// that agree while the joint is closed.
void add_bodies(Draws& draws, RandomKnee& knee);
void add_surfaces(Draws& draws, RandomKnee& knee);
void add_lines(Draws& draws, RandomKnee& knee);
void add_wraps(Draws& draws, RandomKnee& knee);
void add_loads(Draws& draws, RandomKnee& knee);
/// Each body gets a frame of its own, the moving one its start pose.
void move_frames(Draws& draws, RandomKnee& knee);
/// Conditions and sweep, about the coordinates that the start pose has.
void add_motions(Draws& draws, RandomKnee& knee);

}  // namespace condyle::random_knees
