#pragma once

/// Two texts line by line [Myers 1986, An O(ND) difference algorithm].

#include <optional>
#include <string>
#include <vector>

namespace condyle {

struct DifferenceLine {
  enum class Kind { kSame, kOnlyFirst, kOnlySecond, kLeftOut };
  Kind kind = Kind::kSame;
  std::string text;  ///< of kLeftOut empty: lines that are the same and far from a difference
};

/// Lines that differ with `context` lines about them; none where all are the same. Nothing where the
/// texts differ in more than some 2,000 lines.
[[nodiscard]] std::optional<std::vector<DifferenceLine>> text_difference(const std::string& first,
                                                                         const std::string& second,
                                                                         std::size_t context = 2);

}  // namespace condyle
