#pragma once

/// The motion of a network in time, by CVODE: backward differentiation with projection onto the
/// constraints where there are any, Adams' method where there are none. Contacts open where their
/// force vanishes and close, with an impact, where their gap does; both are located by root
/// finding.

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "condyle/network/integrate_options.h"
#include "condyle/network/motion.h"

namespace condyle {

/// What a detection has found.
struct DetectedContacts {
  /// Smallest gap at places that no contact followed [mm].
  double unseen = std::numeric_limits<double>::infinity();
  double followed = unseen;           ///< and of the open contacts that overlap [mm]
  std::vector<int> overlapping = {};  ///< these
  std::string lost = {};              ///< a closed contact that has left what is known: the end
};
/// Lets waiting contacts follow the places at which bodies have come near each other and that no
/// contact follows yet.
using ContactDetection = std::function<DetectedContacts(NetworkState&)>;

/// How a motion goes on where another run of it was stopped.
struct MotionKeeping {
  std::vector<MotionStretch> earlier;                    ///< of that run, taken over as they are
  std::function<void(const MotionStretch&)> on_stretch;  ///< told of each that is computed
  std::function<void()> forget;  ///< has the detection forget the frames before
};

/// From `start`, whose closed contacts must touch. Throws InputError for an inconsistent network, a
/// body without mass, or a start that violates its constraints; what fails later is told in the
/// result. Detection is asked for every 2 ms and at every frame; where it finds an overlap, the way from the last
/// time is repeated in halves until it finds the place before the bodies touch there. Throws InputError for stretches that are
/// of no such motion.
[[nodiscard]] Motion integrate(const Network& network,
                               NetworkState start,
                               const IntegrationOptions& options,
                               ContactDetection detect = {},
                               const MotionKeeping& keeping = {});

}  // namespace condyle
