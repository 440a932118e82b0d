#pragma once

/// How a command talks: in plain lines on the standard output; not at all but for errors
/// (--quiet); or by one JSON object when it is done (--json), also where it fails.

#include <fmt/format.h>

#include <functional>
#include <string>
#include <utility>

#include "condyle/app/tell.h"

namespace CLI {
class App;
}

namespace condyle {

struct Talk {
  std::string command;  ///< its name
  bool quiet = false, json = false;
  [[nodiscard]] bool plain() const { return !quiet && !json; }
};

/// --quiet and --json.
void add_talk_options(CLI::App& command, Talk& talk);

template <class... Values>
void say(const Talk& talk, fmt::format_string<Values...> format, Values&&... values) {
  if (talk.plain()) tell(format, std::forward<Values>(values)...);
}

/// The work of a command; with --json an error becomes {"command", "error", ...} on the standard
/// output before it goes on its way.
int run_telling_errors(const Talk& talk, const std::function<int()>& work);

}  // namespace condyle
