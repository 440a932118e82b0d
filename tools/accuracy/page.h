#pragma once

/// docs/accuracy.md holds, between `<!-- measured: NAME -->` and `<!-- end -->`, what one run of
/// the studies found; the rest is written by hand.

#include <string>

namespace condyle::accuracy {

/// `page` with another content of the block. Throws where there is none of that name.
[[nodiscard]] std::string with_block(const std::string& page,
                                     const std::string& name,
                                     const std::string& content);

/// The machine and the day, one line.
[[nodiscard]] std::string machine();

}  // namespace condyle::accuracy
