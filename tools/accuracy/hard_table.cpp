#include <fmt/format.h>
#include <fmt/os.h>

#include "accuracy/study.h"
#include "hard/hard_cases.h"

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

std::string study_hard_cases(const std::filesystem::path& folder,
                             const std::filesystem::path& root) {
  fmt::ostream csv = fmt::output_file((folder / "hard_cases.csv").string());
  csv.print("case,scene,statuses,iterations,residual_N,condition,error\n");
  std::string page =
      "### Hard cases\n\n"
      "| case | what is hard, and what has to happen | statuses | most iterations | residual [N] | "
      "condition | error |\n|---|---|---|---|---|---|---|\n";
  for (const hard::HardCase& one : hard::hard_cases()) {
    const hard::HardOutcome outcome = hard::run(one, root);
    const std::string error = one.tolerance > 0 ? fmt::format("{:.0e}", outcome.error) : "";
    const std::string condition =
        outcome.condition > 0 ? fmt::format("{:.0e}", outcome.condition) : "";
    csv.print("\"{}\",{},{},{},{:.3e},{},{}\n", one.name, one.file, outcome.statuses,
              outcome.iterations, outcome.residual, condition, error);
    page += fmt::format("| {} | {} | {} | {} | {:.0e} | {} | {} |\n", one.name, one.why,
                        counted(outcome.statuses), outcome.iterations, outcome.residual, condition,
                        error);
  }
  return page +
         "\nStatuses, poses and their letter: c converged, l left patch, n no equilibrium, s "
         "singular, "
         "z zero "
         "length, i iteration limit.\n\n";
}

}  // namespace condyle::accuracy
