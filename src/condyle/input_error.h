#pragma once

/// Bad input: the one exception this library throws.
///
/// What the user gave (a file, a mesh, a value in a scene) cannot be used. `what()` is one clear
/// line with file, place, key, value and what was expected, for example
///     knee.toml:41: ligament "aACL": slack_length = -2, expected a length > 0
/// A computation that does not succeed never throws: it reports a status.

#include <stdexcept>
#include <string>

namespace condyle {

/// Line ends become blanks, other control characters '?': what a file quotes is one line, and no command to
/// a terminal.
[[nodiscard]] std::string one_line(std::string text);

class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(one_line(message)) {}
};

}  // namespace condyle
