#include <nlohmann/json.hpp>

#include "condyle/report/summary_json.h"
#include "condyle/results/run_view.h"

namespace condyle {

std::string json_verification(const CommandSummary& summary,
                              const Run& run,
                              const Verification& verification) {
  using Document = nlohmann::ordered_json;
  Document json = {{"command", summary.command},     {"version", summary.version},
                   {"exit_code", summary.exit_code}, {"seconds", summary.seconds},
                   {"run", summary.output},          {"scene", run.scene.file.string()},
                   {"title", run.scene.title},       {"verified", verification.verified()}};
  json["counts"] = {{"poses", verification.poses},
                    {"converged", verification.converged},
                    {"false", verification.false_poses}};
  json["checks"] = Document::array();
  for (const CheckSummary& check : verification.checks) {
    if (check.count == 0) continue;
    json["checks"].push_back({{"check", check.name},
                              {"units", check.units},
                              {"worst", check.figure},
                              {"allowed", check.allowed},
                              {"count", check.count},
                              {"wrong", check.failed},
                              {"where", check.where}});
  }
  const SweptQuantity swept = swept_quantity(run);
  json["false_poses"] = Document::array();
  for (const Fault& fault : verification.faults)
    json["false_poses"].push_back(
        {{"value", swept.shown(run.sweep.poses[fault.pose].value)},
         {"check", verification.checks[static_cast<std::size_t>(fault.check)].name},
         {"text", fault.text}});
  json["warnings"] = verification.warnings;
  json["not_checked"] = verification.not_checked;
  return json.dump(2, ' ', false, Document::error_handler_t::replace);
}

}  // namespace condyle
