#include "condyle/design/uniform_draws.h"

#include <algorithm>

#include "condyle/design/random_bits.h"

namespace condyle {

void uniform_draws(std::uint64_t seed,
                   std::uint64_t what,
                   std::uint64_t sample,
                   std::vector<double>& u) {
  for (std::size_t i = 0; i < u.size(); i += 4) {
    // The third word tells these draws from normal_draws, where it is 0.
    const std::array<std::uint64_t, 4> bits = random_bits({i / 4, sample, 1, 0}, {seed, what});
    const std::size_t used = std::min<std::size_t>(4, u.size() - i);
    for (std::size_t c = 0; c < used; ++c) u[i + c] = open_unit(bits[c]);
  }
}

}  // namespace condyle
