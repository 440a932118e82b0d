#pragma once

/// A program of subcommands: its command line read, and the one that is named called.

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace condyle {

inline constexpr int kBadInput = 1;

/// Adds a subcommand, which puts its exit code where it is told (commands.h).
using SetupCommand = std::function<void(CLI::App&, int&)>;

/// Returns the exit code. Throws InputError where the command line is not understood, and whatever the
/// subcommand throws.
int run_program(const std::string& name,
                const std::string& description,
                const std::vector<SetupCommand>& commands,
                int argc,
                char** argv);

}  // namespace condyle
