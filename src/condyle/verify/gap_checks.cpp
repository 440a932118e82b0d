#include "condyle/verify/gap_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/verify/layer_checks.h"

namespace condyle::verification {

GapCheck::GapCheck(const Subject& subject, std::vector<std::string>& not_checked)
    : subject_(subject) {
  const Scene& scene = subject.run.scene;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const bool layer = scene.contacts[i].layer.has_value();
    const std::string name = fmt::format("contact \"{}\"", scene.contacts[i].name);
    if (!layer && scene.contacts[i].state == ContactState::kOpen) {
      not_checked.push_back(name + " is held open by the scene: its surfaces may overlap");
      continue;
    }
    const PairOfSides sides = pair_of(subject, i);
    pairs_.push_back({i, sides, GapProbe(*sides.fixed, *sides.moving),
                      GapProbe(*sides.moving, *sides.fixed),
                      layer ? bearable_depth(subject, i) : 0});
    if (!pairs_.back().from_fixed.covers() && !pairs_.back().from_moving.covers())
      not_checked.push_back(name + ": neither surface has bounds, so no gaps were looked at");
  }
}

double GapCheck::Pair::may_overlap() const { return kDepthAllowed * bears; }

/// Of both sides; an overlap, or no number, that one of them finds is one whatever the other could look at.
GapCheck::FoundGap GapCheck::find_lowest(const Pair& pair, const RigidTransform& X_BA) {
  const double wanted = -pair.may_overlap();
  const LowestGap fixed = pair.from_fixed.lowest(X_BA.inverse(), wanted);
  const LowestGap moving = std::isnan(fixed.gap) ? fixed : pair.from_moving.lowest(X_BA, wanted);
  const bool on_fixed = std::isnan(fixed.gap) || fixed.gap < moving.gap;
  LowestGap lowest = on_fixed ? fixed : moving;
  lowest.behind = fixed.behind || moving.behind;
  lowest.exact = (fixed.exact && moving.exact) || !(lowest.gap >= wanted - GapProbe::kNoise);
  return {lowest, on_fixed};
}

void GapCheck::check(const PoseResult& pose, Ledger& ledger) const {
  const Scene& scene = subject_.run.scene;
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  for (const Pair& pair : pairs_) {
    const auto [lowest, on_fixed] = find_lowest(pair, pose.X_BA);
    const int surface = on_fixed ? pair.sides.fixed_surface : pair.sides.moving_surface;
    const std::string& body = scene.bodies[at(scene.surfaces[at(surface)].body)].name;
    const double rounding = 1e-13 * pose.X_BA.p.norm();
    const auto name = [&](int i) { return scene.surfaces[at(i)].name; };
    const std::string between =
        fmt::format("surfaces \"{}\" and \"{}\"", name(pair.sides.fixed_surface),
                    name(pair.sides.moving_surface));
    if (lowest.behind)
      ledger.leave_out(fmt::format(
          "what of {} lies behind the other's back, where its bone may have ended: deeper than "
          "that reaches from its middle",
          between));
    if (!lowest.exact) {
      ledger.leave_out(fmt::format("the gap of {}: too many places to look at", between));
      continue;
    }
    const std::string words =
        std::isnan(lowest.gap)
            ? between + " cannot be told apart: their gap has no number"
            : fmt::format(
                  "{} overlap by {:.6g} mm at [{:.3f}, {:.3f}, {:.3f}] mm of {}{}", between,
                  -lowest.gap, lowest.point.x(), lowest.point.y(), lowest.point.z(), body,
                  pair.bears > 0 ? fmt::format(", their layers bear {:.4g} mm", pair.bears) : "");
    const double deeper = std::max(0.0, -lowest.gap - pair.may_overlap());
    ledger.note(Check::kGap, std::isnan(lowest.gap) ? lowest.gap : deeper,
                fmt::format("contact \"{}\"", scene.contacts[pair.contact].name), words,
                1e-6 + rounding);
  }
}

}  // namespace condyle::verification
