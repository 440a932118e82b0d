#pragma once

/// Looks for new places of contact while a knee moves, with the search of the equilibrium room.

#include "condyle/contact/contact_search.h"
#include "condyle/network/integrate.h"
#include "condyle/network/knee_network.h"

namespace condyle {

class KneeContactDetection {
 public:
  /// Keeps references.
  KneeContactDetection(const Model& model, const ContactCovers& covers, const KneeNetwork& knee);

  /// As newly made.
  void forget();
  /// As ContactDetection says.
  DetectedContacts operator()(NetworkState& state);

 private:
  void detect_in_pair(int pair, NetworkState& state, DetectedContacts& detected);
  void set_known(int pair, const NetworkState& state);
  [[nodiscard]] int follower_of(int pair,
                                const GapMinimum& minimum,
                                const NetworkState& state) const;
  [[nodiscard]] int waiting_contact(int pair, const NetworkState& state) const;
  void drop_doubles(int pair, NetworkState& state) const;
  [[nodiscard]] std::string lost_contact(const NetworkState& state) const;
  [[nodiscard]] std::string lost_layer(const NetworkState& state);
  [[nodiscard]] double length_of(int pair) const { return searches_[pair].length(model_.length); }
  [[nodiscard]] Eigen::Vector3d point_of(int contact, const NetworkState& state) const;

  const Model& model_;
  const KneeNetwork& knee_;
  std::vector<ContactSearch> searches_;  ///< one for each of Model::pairs
  std::vector<GapMinimum> minima_;
  std::vector<KnownContact> known_;
  ContactResult described_;
};

/// Why a closed contact so far from the edge of its patch [mm] is none: beyond it the surface is a
/// guess. Empty where it is not beyond.
[[nodiscard]] std::string beyond_edge(const ContactPair& pair, double edge_distance);

}  // namespace condyle
