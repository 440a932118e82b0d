#pragma once

/// Runs another program without a shell, feeds its standard input and collects what it writes and
/// what it complains of, in memory. Nothing is left behind where either is interrupted.

#include <string>
#include <vector>

namespace condyle {

struct ProgramResult {
  bool started = false;  ///< false: there is no such program, or no room for it
  int exit_code = -1;    ///< -1 when it was ended by a signal
  std::string output;    ///< standard output, bytes
  std::string
      messages;  ///< standard error, on one line; or which signal ended it, or why it was not started
};

/// `command` holds the program, found along PATH, and its arguments.
[[nodiscard]] ProgramResult run_program(const std::vector<std::string>& command,
                                        const std::string& input);

/// Throws PictureError where it was not: with `missing` where there is no such program, or with the reason.
void expect_started(const ProgramResult& result, const std::string& missing);

}  // namespace condyle
