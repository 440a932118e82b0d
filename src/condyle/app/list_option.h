#pragma once

/// Options whose value is a list, a,b,c: CLI11's own delimiter passes over items that are empty.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace condyle {

/// Finite numbers; an item that is none is told with the whole list.
void add_list(CLI::App& command,
              const std::string& name,
              std::vector<double>& numbers,
              const std::string& help);

/// Words, of at least one character; those there are the default.
void add_list(CLI::App& command,
              const std::string& name,
              std::vector<std::string>& words,
              const std::string& help);

}  // namespace condyle
