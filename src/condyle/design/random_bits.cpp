#include "condyle/design/random_bits.h"

#include <Random123/philox.h>

#include <Random123/uniform.hpp>

namespace condyle {

std::array<std::uint64_t, 4> random_bits(const std::array<std::uint64_t, 4>& counter,
                                         const std::array<std::uint64_t, 2>& key) {
  const auto bits = r123::Philox4x64{}({{counter[0], counter[1], counter[2], counter[3]}},  //
                                       {{key[0], key[1]}});
  return {bits[0], bits[1], bits[2], bits[3]};
}

double open_unit(std::uint64_t bits) { return r123::u01fixedpt<double>(bits); }

}  // namespace condyle
