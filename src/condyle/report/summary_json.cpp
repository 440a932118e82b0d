#include "condyle/report/summary_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "condyle/calibration/calibration_words.h"
#include "condyle/calibration/told_parameter.h"
#include "condyle/calibration/told_units.h"
#include "condyle/compare/laxity.h"
#include "condyle/elements/joint_table.h"
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
  const JointCoordinate& along = kJointCoordinates[loaded_coordinate(run.scene)];
  for (const LaxityCurve& curve : run.laxity()->curves) {
    Json row = {{"flexion_deg", in_unit(curve.flexion, {"deg", kDegree})},
                {"knee", curve.cut ? "cut" : "intact"},
                {"coordinate", along.name},
                {"unit", along.angle ? "deg" : "mm"},
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
  Json steps, seconds, imbalance;  // null where the motion was read
  if (motion.computed) {
    steps = motion.computed->steps;
    seconds = motion.computed->seconds;
    imbalance = motion.computed->imbalance;
  }
  return {{"completed", motion.completed},
          {"reason", motion.reason},
          {"steps", steps},
          {"seconds", seconds},
          {"imbalance", imbalance},
          {"events", std::move(events)}};
}

Json agreement_of(const Agreement& a) {
  return {{"name", a.name},
          {"rows", a.rows},
          {"lost", a.lost},
          {"rms_before", a.before},
          {"rms_after", a.after},
          {"length_before_mm", a.length_before},
          {"length_after_mm", a.length_after},
          {"angle_before_deg", in_unit(a.angle_before, {"deg", kDegree})},
          {"angle_after_deg", in_unit(a.angle_after, {"deg", kDegree})},
          {"covered", a.covered}};
}

Json parameters_of(const CalibrationResult& result) {
  Json parameters = Json::array();
  for (const ToldParameter& told : told_parameters(result)) {
    Json row = {
        {"name", told.name},           {"unit", told.unit},           {"scene", told.scene},
        {"prior_sd", told.prior_sd},   {"mean", told.mean},           {"sd", told.sd},
        {"sample_sd", told.sample_sd}, {"shrinkage", told.shrinkage}, {"at_bound", told.at_bound}};
    if (told.at_bound) row["sd"] = row["sample_sd"] = row["shrinkage"] = Json();
    parameters.push_back(std::move(row));
  }
  return parameters;
}

Json starts_of(const CalibrationResult& result) {
  Json starts = Json::array();
  for (const CalibrationStart& start : result.starts)
    starts.push_back({{"cost", start.cost},
                      {"distance", start.distance},
                      {"converged", start.converged},
                      {"iterations", start.iterations},
                      {"message", start.message}});
  return starts;
}

Json suggested_of(const CalibrationResult& result, const Scene& scene) {
  Json tests = Json::array();
  for (const SuggestedTest& test : result.suggested) {
    const bool loaded = test.load >= 0 && scene.calibration;
    const Unit unit = unit_of_level(scene, test.load);
    tests.push_back(
        {{"flexion_deg", in_unit(test.flexion, {"deg", kDegree})},
         {"load", loaded ? scene.calibration->loads.at(static_cast<std::size_t>(test.load)).name
                         : std::string("none")},
         {"level", test.level / unit.factor},
         {"level_unit", unit.name},
         {"information", test.information},
         {"shrinkage", test.shrinkage},
         {"reason", test.reason}});
  }
  return tests;
}

Json calibration_of(const Run& run) {
  const CalibrationResult& result = *run.calibration();
  Json tests = Json::array();
  for (const Agreement& test : result.tests) tests.push_back(agreement_of(test));
  const Eigen::VectorXd& values = result.known.singular_values;
  return {{"table", result.table.file.string()},
          {"specimen", result.table.specimen},
          {"stopped", result.stopped},
          {"converged", result.fit.converged},
          {"counts",
           {{"parameters", result.parameters.size()},
            {"rows", result.table.rows.size()},
            {"iterations", result.fit.iterations},
            {"poses", result.poses},
            {"failed_poses", result.failed_poses},
            {"samples", result.samples.rows()},
            {"lost_samples", result.lost_samples}}},
          {"parameters", parameters_of(result)},
          {"determined", result.known.determined},
          {"effective", result.known.effective},
          {"singular_values", std::vector<double>(values.begin(), values.end())},
          {"weakest", weak_directions(result, 5)},
          {"chi_square", result.fit.chi_square},
          {"reduced_chi_square", result.reduced_chi_square},
          {"reduced_chi_square_limit", result.reduced_chi_square_limit},
          {"agreements",
           {{"fitted", agreement_of(result.fitted)},
            {"unseen", agreement_of(result.unseen)},
            {"tests", std::move(tests)}}},
          {"silent", result.silent},
          {"starts", starts_of(result)},
          {"cold_difference", result.cold_difference},
          {"suggested", suggested_of(result, run.scene)},
          {"fit_seconds", result.fit_seconds}};
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
  if (run.calibration()) json["calibration"] = calibration_of(run);
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
