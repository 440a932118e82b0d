#include "condyle/report/summary_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "condyle/compare/laxity.h"
#include "condyle/results/motion_view.h"
#include "condyle/results/run_layout.h"
#include "condyle/results/run_view.h"
#include "condyle/scene/ligament_path.h"

namespace condyle {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

Json counts_of(const SweepResult& sweep) {
  Json counts = {{"poses", sweep.poses.size()}};
  for (int i = 0; i < kPoseStatusCount; ++i) {
    int count = 0;
    for (const PoseResult& pose : sweep.poses) count += static_cast<int>(pose.status) == i ? 1 : 0;
    if (count > 0 || i == 0) counts[name(static_cast<PoseStatus>(i))] = count;
  }
  return counts;
}

Json joint_of(const PoseResult& pose) {
  Json joint = Json::object();
  for (const auto& column : kJointColumns)
    joint[column.name] = in_unit(pose.joint.*column.member, {column.units, column.unit});
  return joint;
}

void add_trace(const PoseTrace& trace, Json& row) {
  if (!trace.told()) return;
  row["route"] = name(trace.route);
  row["route_from"] = name(trace.origin);
  row["parts"] = trace.parts;
  row["searches"] = trace.searches;
  row["closings"] = trace.closings;
  row["openings"] = trace.openings;
  row["residuals"] = std::vector<double>(trace.residuals.begin(), trace.residuals.end());
}

/// Of contacts that carry by elastic layers; null where there are none.
Json layers_of(const Scene& scene, const PoseResult& pose) {
  Json layers;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    if (!scene.contacts[i].layer || !pose.solved()) continue;
    const ContactResult& contact = pose.contacts.at(i);
    Json& row = layers[scene.contacts[i].name];
    row["force"] = contact.force;
    if (!contact.layer) continue;
    const LayerResult& layer = *contact.layer;
    const Eigen::Vector3d& center = contact.resultant_ground;
    row["area_mm2"] = layer.area;
    row["pressure_mean"] = layer.mean_pressure;
    row["pressure_max"] = layer.peak_pressure;
    row["depth_mm"] = layer.deepest;
    row["center_of_pressure"] = std::vector<double>(center.begin(), center.end());
    row["lost_force"] = layer.lost;
    row["lateral_ratio"] = layer.lateral;
    row["error"] = layer.error;
  }
  return layers;
}

Json poses_of(const Run& run, const SweptQuantity& swept, const SweepResult& sweep) {
  Json poses = Json::array();
  for (const PoseResult& pose : sweep.poses) {
    Json row = {{"value", swept.shown(pose.value)},
                {"status", name(pose.status)},
                {"reason", pose.reason},
                {"remark", pose.remark},
                {"iterations", pose.iterations},
                {"residual", pose.residual},
                {"seconds", pose.seconds},
                {"event_seconds", pose.event_seconds}};
    add_trace(pose.trace, row);
    if (run.scene.joint && pose.solved()) row["joint"] = joint_of(pose);
    if (Json layers = layers_of(run.scene, pose); !layers.is_null())
      row["layers"] = std::move(layers);
    poses.push_back(std::move(row));
  }
  return poses;
}

Json events_of(const Run& run, const SweptQuantity& swept) {
  Json events = Json::array();
  for (const Event& event : run.sweep.events) {
    Json row = {{"value", swept.shown(event.value)}, {"kind", name(event.kind)}};
    row["contact"] = event.contact < 0
                         ? Json()
                         : Json(run.scene.contacts[static_cast<std::size_t>(event.contact)].name);
    if (event.ligament >= 0) {
      const LigamentDescription& ligament =
          run.scene.ligaments[static_cast<std::size_t>(event.ligament)];
      row["ligament"] = ligament.name;
      row["wrap"] =
          run.scene.wraps[static_cast<std::size_t>(wrap_on_path(run.scene, ligament, event.wrap))]
              .name;
    }
    events.push_back(std::move(row));
  }
  return events;
}

Json patches_of(const Run& run) {
  Json patches = Json::array();
  for (const RunPatch& patch : run.patches) {
    patches.push_back({{"surface", patch.surface},
                       {"rms_mm", patch.report.rms},
                       {"max_mm", patch.report.max},
                       {"notes", patch.report.notes}});
  }
  return patches;
}

Json laxity_of_run(const Run& run) {
  Json curves = Json::array();
  for (const LaxityCurve& curve : run.laxity()->curves) {
    Json row = {{"flexion_deg", in_unit(curve.flexion, {"deg", kDegree})},
                {"knee", curve.cut ? "cut" : "intact"},
                {"laxity", laxity_of(run.scene, curve.ours)},
                {"counts", counts_of(curve.ours)}};
    if (curve.reference) {
      row["reference_laxity"] = laxity_of(run.scene, *curve.reference);
      row["reference_counts"] = counts_of(*curve.reference);
    }
    curves.push_back(std::move(row));
  }
  return curves;
}

Json simulation_of(const MotionView& motion) {
  Json events = Json::array();
  for (const MotionEvent& event : motion.events) {
    events.push_back({{"time", event.time},
                      {"contact", event.contact},
                      {"kind", event.closing ? "closing" : "opening"},
                      {"speed_mm_s", event.speed}});
  }
  return {{"completed", motion.completed}, {"reason", motion.reason},
          {"steps", motion.steps},         {"seconds", motion.seconds},
          {"imbalance", motion.imbalance}, {"events", std::move(events)}};
}

void add_run(Json& json, const Run& run) {
  json["scene"] = run.scene.file.string();
  json["title"] = run.scene.title;
  if (!run.patches.empty()) json["patches"] = patches_of(run);
  const SweptQuantity swept = swept_quantity(run);
  if (!run.sweep.poses.empty()) {
    json["swept"] = {{"name", swept.name}, {"units", swept.unit.name}};
    json["counts"] = counts_of(run.sweep);
    json["poses"] = poses_of(run, swept, run.sweep);
    json["events"] = events_of(run, swept);
  }
  if (const SweepResult* reference = reference_poses(run))
    json["reference"] = {{"counts", counts_of(*reference)},
                         {"poses", poses_of(run, swept, *reference)}};
  if (run.laxity()) json["laxity"] = laxity_of_run(run);
  if (const auto motion = motion_view(run)) json["simulation"] = simulation_of(*motion);
}

}  // namespace

std::string json_summary(const CommandSummary& summary, const Run& run) {
  Json json = {{"command", summary.command},
               {"version", summary.version},
               {"exit_code", summary.exit_code},
               {"seconds", summary.seconds}};
  if (!summary.output.empty()) json["run"] = summary.output;
  add_run(json, run);
  std::vector<std::string> warnings = run_warnings(run);
  warnings.insert(warnings.end(), summary.warnings.begin(), summary.warnings.end());
  json["warnings"] = warnings;
  if (!summary.files.empty()) {
    json["files"] = Json::array();
    for (const std::filesystem::path& file : summary.files) json["files"].push_back(file.string());
  }
  return text_of(json);
}

std::string json_error(const std::string& command,
                       const std::string& version,
                       const std::string& error) {
  return text_of({{"command", command}, {"version", version}, {"exit_code", 1}, {"error", error}});
}

}  // namespace condyle
