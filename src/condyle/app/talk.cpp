#include "condyle/app/talk.h"

#include <CLI/CLI.hpp>
#include <exception>

#include "condyle/app/tell.h"
#include "condyle/report/summary_json.h"
#include "condyle/version.h"

namespace condyle {

void add_talk_options(CLI::App& command, Talk& talk) {
  talk.command = command.get_name();
  command.add_flag("--quiet", talk.quiet, "say nothing but errors");
  command.add_flag("--json", talk.json,
                   "one JSON object on the standard output, in place of the lines for people");
}

int run_telling_errors(const Talk& talk, const std::function<int()>& work) {
  if (!talk.json) return work();
  try {
    return work();
  } catch (const std::exception& error) {
    tell("{}\n", json_error(talk.command, CONDYLE_VERSION, error.what()));
    throw;
  }
}

}  // namespace condyle
