#include <fmt/format.h>
#include <fmt/os.h>

#include "accuracy/study.h"
#include "support/hard_cases.h"

namespace condyle::accuracy {
namespace {

/// "ccccll" as "4 c 2 l".
std::string counted(const std::string& statuses) {
  std::string text;
  for (std::size_t i = 0, run; i < statuses.size(); i += run) {
    const std::size_t end = statuses.find_first_not_of(statuses[i], i);
    run = (end == std::string::npos ? statuses.size() : end) - i;
    text += fmt::format("{}{} {}", i > 0 ? " " : "", run, statuses[i]);
  }
  return text;
}

}  // namespace

Study study_hard_cases(const Setting& setting) {
  fmt::ostream csv = setting.table("hard_cases");
  csv.print("case,scene,statuses,iterations,residual_N,condition,error\n");
  Study study;
  study.page =
      "| case | what is hard | what has to happen | statuses | most iterations | residual [N] | "
      "condition | error |\n|---|---|---|---|---|---|---|---|\n";
  int as_expected = 0, count = 0;
  for (const hard::HardCase& one : hard::hard_cases()) {
    const hard::HardOutcome outcome = hard::run(one, setting.root);
    const bool solved = outcome.sweep.count_converged() > 0;
    const std::string error = solved ? fmt::format("{:.0e}", outcome.error) : "";
    const std::string residual = solved ? fmt::format("{:.0e}", outcome.residual) : "";
    const std::string condition = fmt::format("{:.0e}", outcome.condition);
    csv.print("\"{}\",{},{},{},{},{},{}\n", one.name, one.file, outcome.statuses,
              outcome.iterations, residual, condition, error);
    study.page +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", one.name, one.why, one.wanted,
                    counted(outcome.statuses), outcome.iterations, residual, condition, error);
    const bool good = outcome.as_expected(one) && outcome.finite && outcome.has_words &&
                      outcome.error <= one.tolerance;
    study.require(good, fmt::format("hard case \"{}\": {}", one.name, one.wanted));
    as_expected += good ? 1 : 0;
    ++count;
  }
  study.page +=
      "\nStatuses, poses and their letter: c converged, l left patch, n no equilibrium, s "
      "singular, "
      "z zero length, i iteration limit. Iterations include those of the descent and of parts of a "
      "step. Condition: of Newton's matrix (rows in N and mm), the largest of the poses that "
      "converged.\n";
  study.in_short = {
      fmt::format("**{} of {} hard cases behave as they should**: nothing crashes, hangs or is "
                  "wrong and called "
                  "converged. Each is a scene of `data/hard`; the tests check the table below.",
                  as_expected, count)};
  return study;
}

}  // namespace condyle::accuracy
