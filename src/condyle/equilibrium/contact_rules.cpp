#include "condyle/equilibrium/contact_rules.h"

#include <fmt/format.h>

#include <algorithm>

#include "condyle/contact/contact_scales.h"
#include "condyle/equilibrium/motion_name.h"

namespace condyle {
namespace {

constexpr double kPull = 1e-12;              // round-off, of all forces
constexpr double kFlat = 1e-7;               // relative curvature [1/mm] that counts as none
constexpr double kRim = 2 * kSampleSpacing;  // from an edge; of the length of the pair, as all
constexpr double kUnseen = 0.5 / 30;         // a law that sums over points sees nothing of
                                             // what touches between them, so deep at most

/// The contact that pulls most, beyond round-off; -1 where none does.
int most_pulling(const Linearization& at) {
  int worst = -1;
  double lowest = -kPull * at.force_scale();
  for (std::size_t k = 0; k < at.state.contacts.size(); ++k) {
    const double p = at.state.contacts[k].p;
    if (p >= lowest || !may_open(at, k)) continue;
    worst = static_cast<int>(k);
    lowest = p;
  }
  return worst;
}

/// The contact, of those that may open or of those that may not, that Newton has led to a place where the solids
/// interpenetrate beside it; -1 where none is.
int off_minimum(const Linearization& at, bool opens) {
  for (std::size_t k = 0; k < at.contacts().size(); ++k)
    if (at.contacts()[k].relative_curvature[0] < -kFlat && may_open(at, k) == opens)
      return static_cast<int>(k);
  return -1;
}

struct Overlaps {
  std::vector<ClosedContact>& contacts;
  double lowest = 0;  // gap [mm]
  std::size_t deepest = 0;

  void add(int pair, const GapMinimum& minimum) {
    if (minimum.gap < lowest) deepest = contacts.size();
    lowest = std::min(lowest, minimum.gap);
    contacts.push_back({pair, minimum.places, 0});
  }
};

}  // namespace

bool may_open(const Linearization& at, std::size_t k) {
  const std::vector<ClosedContact>& contacts = at.state.contacts;
  return at.pair(k).mode == ContactMode::kAuto ||
         std::any_of(contacts.begin(), contacts.end(), [&](const ClosedContact& contact) {
           return contact.pair == contacts[k].pair && &contact != &contacts[k];
         });
}

OpenPair look_at_open_pair(const ContactPair& pair,
                           ContactSearch& search,
                           const RigidTransform& X_BA,
                           double L,
                           std::vector<GapMinimum>& nearest) {
  const double length = search.length(L);
  search.find_nearest(X_BA, kAnywhere * L, nearest, kMerge * length);
  // The back of one surface before the other: its solid lies where that one's does.
  std::erase_if(nearest, [](const GapMinimum& minimum) {
    return !minimum.refined && minimum.gap > 0 && minimum.cosine > 0;
  });
  if (nearest.empty()) return OpenPair::kApart;
  const double overlap = pair.law ? kUnseen : kAllowedOverlap;
  return nearest.front().gap < -overlap * length ? OpenPair::kBuried : OpenPair::kClear;
}

std::string overlap_of_held_open(const ContactPair& pair, double gap) {
  constexpr double kOverlap = 1e-3;  // [mm]
  if (pair.mode != ContactMode::kOpen || pair.law || !(gap < -kOverlap)) return "";
  return fmt::format("contact {}, held open, overlaps by {:.2g} mm", quoted(pair.name), -gap);
}

void ContactChanges::apply(EquilibriumState& state) const {
  const int leaves = opens >= 0 ? opens : gives_way;
  if (leaves >= 0) state.contacts.erase(state.contacts.begin() + leaves);
  state.contacts.insert(state.contacts.end(), closes.begin(), closes.end());
}

ContactRules::ContactRules(const Model& model, std::vector<ContactSearch>& searches)
    : model_(model), searches_(searches) {
  changes_.closes.reserve(kMinimaOfAPair);
  rims_.reserve(kMinimaOfAPair);
  known_.reserve(kMaxConstraints);
  minima_.reserve(kMinimaOfAPair);
}

const ContactChanges& ContactRules::changes(const Linearization& at) {
  changes_.closes.clear();
  rims_.clear();
  changes_.deepest = 0;
  changes_.rims = changes_.too_many = false;
  changes_.searches = 0;
  const int off = off_minimum(at, true);
  changes_.off_minimum = off >= 0;
  changes_.gives_way = -1;
  changes_.let_go = false;
  changes_.opens = most_pulling(at);
  if (changes_.opens >= 0) return changes_;
  find_overlaps(at);
  // A point over which the bodies would rock: what it splits into takes its place.
  const bool splits =
      off >= 0 &&
      std::any_of(changes_.closes.begin(), changes_.closes.end(),
                  [&](const ClosedContact& contact) {
                    return contact.pair == at.state.contacts[static_cast<std::size_t>(off)].pair;
                  });
  if (splits) changes_.gives_way = off;
  return changes_;
}

/// What Newton has solved of a pair is a help to the search.
void ContactRules::set_known(int pair, const Linearization& at) {
  known_.clear();
  for (std::size_t k = 0; k < at.state.contacts.size(); ++k) {
    if (at.state.contacts[k].pair != pair) continue;
    known_.push_back(known_contact(at.contacts()[k]));
  }
}

/// Those at a rim only where there are no others: they are no contacts, but may lead Newton to one.
void ContactRules::find_overlaps(const Linearization& at) {
  const EquilibriumState& state = at.state;
  Overlaps inner{changes_.closes}, rims{rims_};
  // One that is held gives way to nothing: whoever tells of the pose objects to it.
  if (off_minimum(at, false) >= 0) return;
  for (std::size_t p = 0; p < searches_.size(); ++p) {
    if (model_.pairs[p].mode == ContactMode::kOpen) continue;
    const int pair = static_cast<int>(p);
    set_known(pair, at);
    changes_.let_go |= model_.pairs[p].mode == ContactMode::kClosed && known_.empty();
    const double length = searches_[p].length(model_.length);
    searches_[p].find(state.X, 0.0, minima_, kMerge * length, known_);
    ++changes_.searches;
    for (const GapMinimum& minimum : minima_) {
      if (minimum.gap > -kAllowedOverlap * length) continue;
      const bool at_rim = !minimum.refined && minimum.edge < kRim * length;
      (at_rim ? rims : inner).add(pair, minimum);
    }
  }
  changes_.rims = inner.contacts.empty() && !rims.contacts.empty();
  if (changes_.rims) inner.contacts.assign(rims.contacts.begin(), rims.contacts.end());
  changes_.deepest = changes_.rims ? rims.deepest : inner.deepest;
  changes_.depth = -(changes_.rims ? rims.lowest : inner.lowest);
  // Several minima of one rough overlap cannot all be contacts: the deepest is the one to begin with.
  const std::size_t others = state.contacts.size() + state.sigma.size();
  if (others + changes_.closes.size() > kMaxConstraints && changes_.closes.size() > 1) {
    changes_.closes.front() = changes_.closes[changes_.deepest];
    changes_.closes.resize(1);
    changes_.deepest = 0;
  }
  changes_.too_many = others + changes_.closes.size() > kMaxConstraints;
}

}  // namespace condyle
