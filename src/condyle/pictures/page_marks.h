#pragma once

/// Marks of a chart page in gnuplot's words.

#include <string>

#include "condyle/pictures/mark.h"

namespace condyle {

struct MarkScript {
  std::string data;     ///< blocks of numbers
  std::string command;  ///< of `plot`, without it; empty where there is nothing to draw
};
[[nodiscard]] MarkScript mark_script(const Mark& mark, const std::string& name);

[[nodiscard]] std::string dot_look(const Mark& mark);
[[nodiscard]] std::string line_look(const Mark& mark);
[[nodiscard]] std::string fill_look(const Mark& mark);

}  // namespace condyle
