#include "condyle/equilibrium/predictor.h"

#include <algorithm>
#include <cmath>

#include "condyle/math/rotation.h"

namespace condyle {
namespace {

constexpr double kLongestRatio = 2.5;  // of the step to the distance between two knots

bool same_contacts(const EquilibriumState& a, const EquilibriumState& b) {
  return std::equal(
      a.contacts.begin(), a.contacts.end(), b.contacts.begin(), b.contacts.end(),
      [](const ClosedContact& x, const ClosedContact& y) { return x.pair == y.pair; });
}

}  // namespace

void Predictor::add(const Drive& drive, const EquilibriumState& state) {
  if (count_ > 0 && !same_contacts(known(0).state, state)) count_ = 0;
  if (count_ == 0) {
    for (Known& entry : history_) {  // room for what may come
      entry.drive = drive;
      entry.state.contacts.reserve(kMaxConstraints);
      entry.state.sigma.reserve(state.sigma.size());
    }
  }
  newest_ = (newest_ + 1) % kMost;
  count_ = std::min(count_ + 1, kMost);
  history_[static_cast<std::size_t>(newest_)].drive = drive;
  history_[static_cast<std::size_t>(newest_)].state = state;
}

/// Where a known drive lies on the line from the newest (t = 0) to the target (t = 1).
bool Predictor::position(const Drive& target, int back, double& t) const {
  const Drive& newest = known(0).drive;
  const Drive& old = known(back).drive;
  double dot = 0, square = 0, old_square = 0;
  const auto add = [&](const std::vector<double>& to, const std::vector<double>& from,
                       const std::vector<double>& point) {
    for (std::size_t i = 0; i < to.size(); ++i) {
      const double step = to[i] - from[i], way = point[i] - from[i];
      dot += step * way;
      square += step * step;
      old_square += way * way;
    }
  };
  add(target.values, newest.values, old.values);
  add(target.scales, newest.scales, old.scales);
  if (!(square > 0) || !(old_square > 0)) return false;
  t = dot / square;
  return std::abs(old_square - t * t * square) < 1e-12 * old_square;
}

bool Predictor::predict(const Drive& drive, EquilibriumState& state) {
  Weights t{};  // of the knots; the newest is at 0, the target at 1
  int points = count_ > 0 ? 1 : 0;
  while (points > 0 && points < count_) {
    const auto k = static_cast<std::size_t>(points);
    if (!position(drive, points, t[k])) break;
    // Knots that crowd together magnify what they leave out.
    bool apart = true;
    for (std::size_t i = 0; i < k; ++i) apart &= std::abs(t[i] - t[k]) > 1 / kLongestRatio;
    if (!apart) break;
    ++points;
  }
  if (points < 2) return false;
  Weights weight{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(points); ++k) {
    weight[k] = 1;
    for (std::size_t i = 0; i < static_cast<std::size_t>(points); ++i)
      if (i != k) weight[k] *= (1 - t[i]) / (t[k] - t[i]);
  }
  extrapolate(weight, points, state);
  return true;
}

void Predictor::extrapolate(const Weights& weight, int points, EquilibriumState& state) const {
  const EquilibriumState& newest = known(0).state;
  state = newest;
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (int k = 1; k < points; ++k) {
    const EquilibriumState& old = known(k).state;
    const double w = weight[static_cast<std::size_t>(k)];
    state.X.p += w * (old.X.p - newest.X.p);
    turn += w * cayley_vector(old.X.R * newest.X.R.transpose());
    for (std::size_t c = 0; c < state.contacts.size(); ++c) {
      ClosedContact& contact = state.contacts[c];
      const ContactPlaces &then = old.contacts[c].places, &now = newest.contacts[c].places;
      contact.places.on_B.numbers += w * (then.on_B.numbers - now.on_B.numbers);
      contact.places.on_A.numbers += w * (then.on_A.numbers - now.on_A.numbers);
      contact.p += w * (old.contacts[c].p - newest.contacts[c].p);
    }
    for (std::size_t i = 0; i < state.sigma.size(); ++i)
      state.sigma[i] += w * (old.sigma[i] - newest.sigma[i]);
  }
  state.X.R = cayley_rotation(turn) * newest.X.R;
  for (ClosedContact& contact : state.contacts) {
    const ContactPair& pair = model_.pairs[static_cast<std::size_t>(contact.pair)];
    contact.places = {pair.on_B->place_of(contact.places.on_B.numbers),
                      pair.on_A->place_of(contact.places.on_A.numbers)};
  }
}

}  // namespace condyle
