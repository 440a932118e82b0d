#include "random/draws.h"

#include <cmath>

#include "condyle/design/random_bits.h"
#include "condyle/math/rotation.h"

namespace condyle::random_knees {

double Draws::unit() {
  if (used_ == bits_.size()) {
    // The third word tells these draws from those of studies.
    bits_ = random_bits({block_++, scene_, 2, 0}, {seed_, 0});
    used_ = 0;
  }
  return open_unit(bits_[used_++]);
}

double Draws::between(double least, double most) { return least + (most - least) * unit(); }

double Draws::of_any_size(double least, double most) {
  return std::exp(between(std::log(least), std::log(most)));
}

bool Draws::chance(double probability) { return unit() < probability; }

int Draws::below(int n) { return static_cast<int>(unit() * n); }

Eigen::Vector3d Draws::within(double half) {
  const double x = between(-half, half), y = between(-half, half), z = between(-half, half);
  return {x, y, z};
}

Eigen::Vector3d Draws::direction() {
  for (;;) {
    const Eigen::Vector3d v = within(1);
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

Eigen::Matrix3d Draws::rotation() {
  const double angle = between(0, M_PI);
  return exp_rotation(angle * direction());
}

}  // namespace condyle::random_knees
