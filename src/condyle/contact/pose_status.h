#pragma once

/// How the search for one pose ended, and why no pose with some contact may be called converged.

#include <string>

namespace condyle {

/// The values are those of /sweep/status.
enum class PoseStatus {
  kConverged = 0,
  kIterationLimit = 1,  ///< the iteration did not settle
  kDiverged = 2,        ///< the pose ran away or a number overflowed
  kSingular = 3,   ///< dependent conditions or contacts, or a motion that nothing resists (named in
                   ///< `reason`)
  kLeftPatch = 4,  ///< a closed contact lies beyond the known part of its surface: an equilibrium
                   ///< on the surface as it is extrapolated there
  kNoEquilibrium = 5,  ///< a load that nothing carries
  kZeroLength = 6,     ///< a line element of zero length
  kOverlap = 7,  ///< the surfaces overlap elsewhere and no admissible set of contacts was found
  kNotComputed = 8,
  kNoPath = 9  ///< a ligament has no shortest path over what it wraps on
};
inline constexpr int kPoseStatusCount = 10;

/// A short name: "converged", "iteration limit", ...
[[nodiscard]] const char* name(PoseStatus status);

/// A sentence and a status where no pose with such a contact may be called converged.
struct Objection {
  PoseStatus status;
  std::string reason;
};

}  // namespace condyle
