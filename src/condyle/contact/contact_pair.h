#pragma once

/// Two surfaces that may touch, B's and A's, in the frames of their bodies [mm].

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "condyle/contact/contact_law.h"
#include "condyle/contact/contact_places.h"
#include "condyle/contact/hertz.h"

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

  /// Of a pair that has both.
  operator SurfacePair() const { return {*on_B, *on_A}; }
};

}  // namespace condyle
