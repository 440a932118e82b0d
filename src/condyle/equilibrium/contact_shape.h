#pragma once

/// What kind of place two surfaces touch in, and what rigid contact cannot say about it.

#include <optional>
#include <string>

#include "condyle/contact/contact_search.h"
#include "condyle/contact/line_contact.h"
#include "condyle/contact/pose_status.h"
#include "condyle/equilibrium/newton.h"

namespace condyle {

enum class Touch {
  kPoint,             ///< isolated
  kLine,              ///< straight, with two ends
  kEndlessLine,       ///< round a ring, or along a cylinder without ends
  kConforming,        ///< over an area
  kInterpenetrating,  ///< the gap is lower beside the point
};

struct TouchReport {
  Touch kind = Touch::kPoint;
  std::array<GapMinimum, 2> ends;  ///< kLine
};

/// Of a point of contact that is solved: gap zero, normals opposite. `L` is the model's length.
[[nodiscard]] TouchReport examine_touch(const ContactPair& pair,
                                        const ContactLinearization& contact,
                                        const ContactPlaces& places,
                                        const RigidTransform& X_BA,
                                        double L);

/// Where no pose with such a contact may be called converged.
[[nodiscard]] std::optional<Objection> objection(Touch kind, const std::string& contact);

/// The resultant of a line contact lies beyond an end.
[[nodiscard]] Objection tips_over(const std::string& contact);

/// One point carries a line: something else holds the bodies parallel.
[[nodiscard]] Objection held_parallel(const std::string& contact);

/// Of a pair with a law of its own: its surfaces overlap somewhere deeper than that bears. Points that face each other's backs
/// carry nothing, so the law does not tell. `minima` is room to work in.
[[nodiscard]] std::optional<Objection> deeper_than_borne(const ContactPair& pair,
                                                         const ContactPotential& potential,
                                                         ContactSearch& search,
                                                         const RigidTransform& X_BA,
                                                         double L,
                                                         std::vector<GapMinimum>& minima);

/// A pair whose surfaces, near each other, have the same curvature in every direction: a ball in a
/// cup of its radius. Nothing says where they will touch.
[[nodiscard]] std::optional<std::size_t> conforming_pair(const Model& model,
                                                         std::vector<ContactSearch>& searches,
                                                         const RigidTransform& X_BA);

/// For a pose that was not solved: does some contact at the last pose that was tried conform, or
/// stand on the end of its line? Then that is why. `searches`: one for each pair.
[[nodiscard]] std::optional<Objection> objection_at(const Model& model,
                                                    std::vector<ContactSearch>& searches,
                                                    const RigidTransform& X_BA);

}  // namespace condyle
