#pragma once

/// Runs another program without a shell, feeds its standard input and collects what it writes and
/// what it complains of. Nothing is left behind where either is interrupted.

#include <string>
#include <vector>

namespace condyle {

struct ProgramResult {
  bool started = false;  ///< false: there is no such program
  int exit_code = -1;    ///< -1 when it was ended by a signal
  std::string output;    ///< standard output, bytes
  std::string messages;  ///< standard error, on one line; or which signal ended it
};

/// `command` holds the program, found along PATH, and its arguments.
[[nodiscard]] ProgramResult run_program(const std::vector<std::string>& command,
                                        const std::string& input);

}  // namespace condyle
