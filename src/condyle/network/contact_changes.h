#pragma once

/// Which contacts are closed after something happened: impact, then forces.

#include <optional>
#include <vector>

#include "condyle/network/integrate_options.h"
#include "condyle/network/motion.h"
#include "condyle/network/network_equations.h"

namespace condyle {

/// Of contacts that touch at one moment: each subset of them is tried.
inline constexpr std::size_t kMostTouching = 16;

/// The state lies on its constraints and some contacts touch. Those that approach are struck apart
/// with `restitution`, no impulse pulling; then the closed contacts are those whose forces push and
/// whose open neighbours do not approach. `released`: contacts that have just ceased to carry.
/// Returns the energy lost [N mm]; events are appended. Absent where more than
/// `kMostTouching` contacts touch.
[[nodiscard]] std::optional<double> change_contacts(NetworkEquations& equations,
                                                    NetworkState& state,
                                                    const std::vector<int>& struck,
                                                    const std::vector<int>& released,
                                                    const IntegrationOptions& options,
                                                    std::vector<ContactEvent>& events);

}  // namespace condyle
