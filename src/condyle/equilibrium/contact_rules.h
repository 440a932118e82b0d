#pragma once

/// What does not agree with unilateral contact at a position of equilibrium.

#include <optional>
#include <vector>

#include "condyle/contact/contact_search.h"
#include "condyle/equilibrium/model_covers.h"
#include "condyle/equilibrium/newton.h"

namespace condyle {

struct Fault {
  int pulling = -1;                      ///< the contact of the state that pulls most
  std::optional<ClosedContact> overlap;  ///< the deepest overlap that is no contact yet
  [[nodiscard]] bool any() const { return pulling >= 0 || overlap; }
};

/// The contact of a state that pulls most, beyond round-off; -1 where none does. `system` assembled
/// at the state.
[[nodiscard]] int most_pulling(const Model& model,
                               const NewtonSystem& system,
                               const EquilibriumState& state);

/// Is a minimum of the gap one of the state's contacts, but for what Newton leaves?
[[nodiscard]] bool is_contact_of(const Model& model,
                                 const EquilibriumState& state,
                                 int pair,
                                 const GapMinimum& minimum);

class ContactRules {
 public:
  /// `covers` as from cover_pairs(model).
  ContactRules(const Model& model, const ContactCovers& covers);

  /// `system` assembled at the state, which is one of equilibrium with its contacts. Where one
  /// pulls, overlaps are not looked for.
  Fault fault(const NewtonSystem& system, const EquilibriumState& state);

 private:
  std::optional<ClosedContact> overlap(const EquilibriumState& state);

  const Model& model_;
  std::vector<ContactSearch> searches_;
  std::vector<GapMinimum> minima_;
};

}  // namespace condyle
