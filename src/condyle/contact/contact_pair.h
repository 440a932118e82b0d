#pragma once

/// Two surfaces that may touch, B's and A's, in the frames of their bodies [mm].

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "condyle/contact/contact_law.h"
#include "condyle/contact/hertz.h"
#include "condyle/surface/surface.h"

namespace condyle {

/// Whether rigid points of contact open and close by themselves, are held closed (they may pull),
/// or are left out.
enum class ContactMode { kAuto, kClosed, kOpen };

struct ContactPair {
  std::string name;
  std::shared_ptr<const Surface> on_B, on_A;
  std::string surface_B, surface_A;  ///< their names
  ContactMode mode = ContactMode::kAuto;
  std::vector<Eigen::Vector3d> start;  ///< first estimates of contact points, ground frame [mm]
  std::optional<ElasticSurface> elastic_B, elastic_A;  ///< absent: rigid
  ContactLaw law = {};  ///< in place of rigid points, `mode` being kOpen; empty: none
};

/// The smaller of a contact's distances from the edges of its two surfaces [mm].
[[nodiscard]] inline double edge_distance(const ContactPair& pair,
                                          const Place& on_B,
                                          const Place& on_A) {
  return std::min(pair.on_B->edge_distance(on_B), pair.on_A->edge_distance(on_A));
}

}  // namespace condyle
