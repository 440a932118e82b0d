#include "condyle/verify/gap_checks.h"

#include <fmt/format.h>

#include <cmath>

namespace condyle::verification {

GapCheck::GapCheck(const Subject& subject, std::vector<std::string>& not_checked)
    : subject_(subject) {
  const Scene& scene = subject.run.scene;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    if (scene.contacts[i].layer) continue;  // layers overlap: layer_checks.h
    const std::string name = fmt::format("contact \"{}\"", scene.contacts[i].name);
    if (scene.contacts[i].state == ContactState::kOpen) {
      not_checked.push_back(name + " is held open by the scene: its surfaces may overlap");
      continue;
    }
    const PairOfSides sides = pair_of(subject, i);
    pairs_.push_back(
        {i, sides, GapProbe(*sides.fixed, *sides.moving), GapProbe(*sides.moving, *sides.fixed)});
    if (!pairs_.back().from_fixed.covers() && !pairs_.back().from_moving.covers())
      not_checked.push_back(name + ": neither surface has bounds, so no gaps were looked at");
  }
}

void GapCheck::check(const PoseResult& pose, Ledger& ledger) const {
  const Scene& scene = subject_.run.scene;
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  for (const Pair& pair : pairs_) {
    const LowestGap fixed = pair.from_fixed.lowest(pose.X_BA.inverse()),
                    moving = std::isnan(fixed.gap) ? fixed : pair.from_moving.lowest(pose.X_BA);
    const bool on_fixed = std::isnan(fixed.gap) || fixed.gap < moving.gap;
    const LowestGap& lowest = on_fixed ? fixed : moving;
    const int surface = on_fixed ? pair.sides.fixed_surface : pair.sides.moving_surface;
    const std::string& body = scene.bodies[at(scene.surfaces[at(surface)].body)].name;
    const double rounding = 1e-13 * pose.X_BA.p.norm();
    const auto name = [&](int i) { return scene.surfaces[at(i)].name; };
    const std::string between =
        fmt::format("surfaces \"{}\" and \"{}\"", name(pair.sides.fixed_surface),
                    name(pair.sides.moving_surface));
    const std::string words =
        std::isnan(lowest.gap)
            ? between +
                  " cannot be told apart: their gap has no number, or too many places to look at"
            : fmt::format("{} overlap by {:.6g} mm at [{:.3f}, {:.3f}, {:.3f}] mm of {}", between,
                          -lowest.gap, lowest.point.x(), lowest.point.y(), lowest.point.z(), body);
    ledger.note(Check::kGap, std::isnan(lowest.gap) ? lowest.gap : std::max(0.0, -lowest.gap),
                fmt::format("contact \"{}\"", scene.contacts[pair.contact].name), words,
                1e-6 + rounding);
  }
}

}  // namespace condyle::verification
