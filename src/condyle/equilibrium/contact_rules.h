#pragma once

/// Which contacts of a solved state open and which close, by unilateral contact: none pulls,
/// nothing overlaps. The one rule of all who ask: Newton between its solutions, the descent about
/// what Newton found from it, the path of equilibria at each of its points.

#include <string>
#include <vector>

#include "condyle/contact/contact_search.h"
#include "condyle/equilibrium/linearization.h"

namespace condyle {

/// Room for the minima of a pair at one pose.
inline constexpr std::size_t kMinimaOfAPair = 64;

struct ContactChanges {
  int opens = -1;                     ///< the contact of the state that pulls most
  std::vector<ClosedContact> closes;  ///< overlaps that are no contacts yet, without force
  std::size_t deepest = 0;            ///< of those
  double depth = 0;                   ///< of the deepest, along the normal of what it lies in [mm]
  bool rims = false;      ///< those are at the edge of a known part, and there are no others
  bool too_many = false;  ///< more overlaps than there may be constraints
  /// A contact lies where the solids interpenetrate beside it: no minimum of the gap.
  bool off_minimum = false;
  int gives_way = -1;  ///< that contact, to overlaps of its pair
  bool let_go =
      false;  ///< a pair that is held closed has no contact; told where overlaps are looked for
  int searches = 0;  ///< that this took

  [[nodiscard]] bool any() const { return opens >= 0 || !closes.empty(); }
  /// Does the state agree with unilateral contact as it is?
  [[nodiscard]] bool none_needed() const { return !any() && !too_many && !off_minimum && !let_go; }
  void apply(EquilibriumState& state) const;
};

/// Does contact k of the state open rather than pull? Of a pair that is held closed the last one does not.
[[nodiscard]] bool may_open(const Linearization& at, std::size_t k);

/// How the two surfaces of a pair that carries nothing by rigid points lie at a pose.
enum class OpenPair {
  kClear,
  kBuried,  ///< one overlaps the other by more than a converged pose may
  kApart    ///< no known parts of them face each other
};

/// `nearest`: afterwards the nearest place that faces the other surface first, unless they are apart.
[[nodiscard]] OpenPair look_at_open_pair(const ContactPair& pair,
                                         ContactSearch& search,
                                         const RigidTransform& X_BA,
                                         double L,
                                         std::vector<GapMinimum>& nearest);

/// What is said of a pair that nothing looks after, held open by its scene, where its surfaces
/// overlap; empty of any other.
[[nodiscard]] std::string overlap_of_held_open(const ContactPair& pair, double gap);

class ContactRules {
 public:
  /// Refers to both; `searches`: one for each pair.
  ContactRules(const Model& model, std::vector<ContactSearch>& searches);

  /// At a state that is one of equilibrium with its contacts. Where one pulls, overlaps are not
  /// looked for. Stays until the next call; allocates nothing once it has held as many.
  const ContactChanges& changes(const Linearization& at);

 private:
  void find_overlaps(const Linearization& at);
  void set_known(int pair, const Linearization& at);

  const Model& model_;
  std::vector<ContactSearch>& searches_;
  ContactChanges changes_;
  std::vector<GapMinimum> minima_;
  std::vector<KnownContact> known_;
  std::vector<ClosedContact> rims_;  ///< lowest samples at an edge, which overlap
};

}  // namespace condyle
