#pragma once

/// What is spent on a pose, counted and not timed: the same on every machine and in every run.

#include <vector>

#include "condyle/contact/contact_potentials.h"
#include "condyle/contact/contact_search.h"

namespace condyle {

struct Work {
  /// That are looked at in the time of an iteration, about.
  static constexpr long kPointsOfAnIteration = 300;

  int iterations = 0;  ///< of Newton and of the descent; one takes about 15 us on a knee
  /// Of surfaces that searches for contacts looked at, and what else takes the time of one, about 0.05 us.
  long points = 0;

  void add(const Work& other) {
    iterations += other.iterations;
    points += other.points;
  }
  /// What is left of this after `spent`: no points can be looked at in the time that iterations took.
  [[nodiscard]] Work after(const Work& spent) const {
    return {iterations - spent.iterations,
            points - spent.points - kPointsOfAnIteration * spent.iterations};
  }
  /// As much as `most` of either, each counted for itself.
  [[nodiscard]] bool reaches(const Work& most) const {
    return iterations >= most.iterations || points >= most.points;
  }
  [[nodiscard]] Work share(int parts) const { return {iterations / parts, points / parts}; }
  /// As much on contact laws that look at fields of points: half a second in place of some 25 ms.
  [[nodiscard]] Work with_laws() const { return {iterations, 24 * points}; }
  [[nodiscard]] bool any() const { return iterations > 0 && points > 0; }
};

/// Points that these searches and laws looked at until now, and what this thread's steps along geodesics took the
/// time of.
[[nodiscard]] long points_until_now(const std::vector<ContactSearch>& searches,
                                    const ContactPotentials& laws);

}  // namespace condyle
