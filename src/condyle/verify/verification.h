#pragma once

/// What verify_run says of a run: each kind of check with its worst figure, and what is wrong.

#include <cstddef>
#include <string>
#include <vector>

namespace condyle {

enum class Check {
  kPose,        ///< finite, and R a rotation
  kJoint,       ///< joint coordinates follow from the pose
  kSlack,       ///< slack lengths follow from reference strains and the start pose
  kLength,      ///< of ligaments, from insertions and pose
  kStrain,      ///< from length and slack length
  kLaw,         ///< forces of ligaments, from the lengths
  kCondition,   ///< what is prescribed is met
  kOnSurface,   ///< points of contact lie on both surfaces
  kTogether,    ///< the point of the one body is the point of the other; stored gaps are right
  kNormal,      ///< normals are those of both surfaces, opposite to each other
  kPush,        ///< contact forces push; open contacts carry nothing
  kKnown,       ///< points of contact lie on the known part of both surfaces
  kForces,      ///< sum of forces, relative to the sum of their magnitudes
  kMoments,     ///< sum of moments about the middle of what acts, likewise
  kGap,         ///< overlap anywhere on the known parts
  kMesh,        ///< meshes passed through each other
  kStability,   ///< energy under small pushes
  kDepth,       ///< stored depths of layers, from their points and the other surface
  kPressure,    ///< stored pressures, from the depths
  kLayerSums,   ///< force and moment of a layer, from its pressures
  kLayerForce,  ///< force of a layer on a grid of the verifier's own
  kLayerDepth,  ///< depth that layers bear
  kPath,        ///< ligaments that wrap: on their surfaces, geodesic there, straight between
  kColumns      ///< numbers and units of the file, from the rest of it
};
inline constexpr int kCheckCount = 24;

/// One kind of check over the whole run.
struct CheckSummary {
  std::string name, units;
  double allowed = 0;
  int count = 0, failed = 0;  ///< of single comparisons
  double worst = 0;           ///< the greatest of them, as a share of what was allowed
  double figure = 0;          ///< that one, in `units`
  std::string where;          ///< which one: pose and element
};

/// Something that is wrong, in words: "flexion = 45 deg: contact "medial": ...".
struct Fault {
  std::size_t pose = 0;  ///< index into SweepResult::poses; the first where it is of the whole run
  Check check = Check::kPose;
  double excess = 0;  ///< times what is allowed
  std::string text;
};

struct Verification {
  std::size_t poses = 0, converged = 0, false_poses = 0;
  std::vector<CheckSummary> checks;  ///< kCheckCount
  std::vector<Fault> faults;         ///< the worst of each kind at each false pose, and of the file
  std::vector<std::string> warnings;     ///< what a reader should know
  std::vector<std::string> not_checked;  ///< what the file or this program leaves unsaid
  double seconds = 0;
  [[nodiscard]] bool verified() const { return faults.empty(); }
};

}  // namespace condyle
