#pragma once

/// What is spent on a pose, counted and not timed: the same on every machine and in every run.

namespace condyle {

struct Work {
  int iterations = 0;  ///< of Newton and of the descent; one takes about 10 us on a knee
  int searches = 0;    ///< of the descent, for contacts of one pair; one takes about 0.3 ms there

  void add(const Work& other) {
    iterations += other.iterations;
    searches += other.searches;
  }
  /// What is left of this after `spent`.
  [[nodiscard]] Work after(const Work& spent) const {
    return {iterations - spent.iterations, searches - spent.searches};
  }
  [[nodiscard]] Work share(int parts) const { return {iterations / parts, searches / parts}; }
  [[nodiscard]] bool any() const { return iterations > 0 && searches > 0; }
};

}  // namespace condyle
