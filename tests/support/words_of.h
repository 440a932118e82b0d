#pragma once

/// What a wrong use is answered with.

#include <functional>
#include <stdexcept>
#include <string>

namespace condyle::test {

inline std::string words_of(const std::function<void()>& wrong) {
  try {
    wrong();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace condyle::test
