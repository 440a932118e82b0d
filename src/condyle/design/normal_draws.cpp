#include "condyle/design/normal_draws.h"

#include <Random123/philox.h>

#include <Random123/boxmuller.hpp>
#include <algorithm>

namespace condyle {

Eigen::VectorXd normal_draws(std::uint64_t seed,
                             DrawsFor what,
                             std::uint64_t sample,
                             Eigen::Index count) {
  Eigen::VectorXd draws(count);
  const r123::Philox4x64 philox;
  for (Eigen::Index i = 0; i < count; i += 4) {
    const auto bits = philox({{static_cast<std::uint64_t>(i / 4), sample, 0, 0}},
                             {{seed, static_cast<std::uint64_t>(what)}});
    const r123::double2 first = r123::boxmuller(bits[0], bits[1]);
    const r123::double2 second = r123::boxmuller(bits[2], bits[3]);
    const Eigen::Vector4d four(first.x, first.y, second.x, second.y);
    const Eigen::Index used = std::min<Eigen::Index>(4, count - i);
    draws.segment(i, used) = four.head(used);
  }
  return draws;
}

}  // namespace condyle
