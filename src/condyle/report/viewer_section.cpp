#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "condyle/exchange/glb_run.h"
#include "condyle/exchange/shown_poses.h"
#include "condyle/report/embedded.h"
#include "condyle/report/html.h"
#include "condyle/report/sections.h"
#include "condyle/report/viewer_pressures.h"
#include "condyle/results/digest.h"
#include "condyle/results/run_layout.h"
#include "condyle/results/strain_scale.h"

namespace condyle {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kBoneTriangles = 20000;  // of each bone: the page stays small

constexpr const char* kMarkup = R"(<p id="viewer-message">The 3-D view needs scripts.</p>
<div id="viewer" hidden>
<canvas aria-label="the knee in three dimensions" tabindex="0"></canvas>
<div class="line"><button type="button" class="play">play</button>
<input class="poses" type="range" min="0" step="0.02" value="0" aria-label="pose">
<output></output></div>
<p class="alarm" role="status" hidden></p>
<ul class="coordinates"></ul>
<div class="views" role="group" aria-label="views"></div>
<div class="toggles" role="group" aria-label="bodies"></div>
<div class="legend"><span>ligament strain (slack ones grey)</span><div class="scale"></div><div class="marks"></div></div>
<div class="legend pressures" hidden><span>pressure of the layers</span><div class="scale"></div><div class="marks"></div></div>
</div>
)";

class ViewerData {
 public:
  ViewerData(const Run& run, const std::string& file, const ShapeOptions& shapes)
      : run_(run), scene_(run.scene), shown_(shown_poses(run, file)), shapes_(shapes) {}

  [[nodiscard]] std::string text() const {
    Json json = {{"title", scene_.title}};
    for (const ShownPose& shown : shown_) json["times"].push_back(shown.time);
    const SweptQuantity swept = swept_quantity(run_);
    json["swept"] = {{"name", swept.name},
                     {"units", swept.unit.name == "1" ? "" : swept.unit.name},
                     {"digits", swept.unit.name == "s"   ? 3
                                : swept.unit.name == "1" ? 2
                                                         : 1},
                     {"values", series([&](const PoseResult& p) { return swept.shown(p.value); })}};
    json["coordinates"] = coordinates(swept);
    json["alarms"] = alarms();
    json["missing"] = missing();
    add_scene(json);
    add_elements(json);
    add_pressures(json);
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
  }

 private:
  template <typename F>
  [[nodiscard]] Json series(const F& value) const {
    Json values = Json::array();
    for (const ShownPose& shown : shown_) {
      const double x = value(run_.sweep.poses[shown.index]);
      values.push_back(std::isfinite(x) ? Json(std::round(1e6 * x) / 1e6) : Json());
    }
    return values;
  }

  [[nodiscard]] Json coordinates(const SweptQuantity& swept) const {
    Json rows = Json::array();
    if (!scene_.joint) return rows;
    for (const auto& column : kJointColumns) {
      if (swept.name == column.name) continue;
      std::string name = column.name;
      std::replace(name.begin(), name.end(), '_', ' ');
      rows.push_back(
          {{"name", name}, {"units", column.units}, {"values", series([&](const PoseResult& p) {
                                                       return p.joint.*column.member / column.unit;
                                                     })}});
    }
    return rows;
  }

  /// Of each pose what is wrong with it; nothing where it is a result.
  [[nodiscard]] Json alarms() const {
    Json words = Json::array();
    for (const ShownPose& shown : shown_) {
      const PoseResult& pose = run_.sweep.poses[shown.index];
      const std::string reason = pose.reason.empty() ? "" : ": " + pose.reason;
      words.push_back(pose.converged() ? "" : name(pose.status) + reason);
    }
    return words;
  }

  /// How many poses are missing between each pose and the next.
  [[nodiscard]] Json missing() const {
    Json counts = Json::array();
    for (std::size_t i = 1; i < shown_.size(); ++i)
      counts.push_back(shown_[i].index - shown_[i - 1].index - 1);
    return counts;
  }

  void add_scene(Json& json) const {
    json["side"] = Json();
    json["femur"] = Json();
    if (scene_.joint) {
      json["side"] = scene_.joint->side == Side::kLeft ? "left" : "right";
      json["femur"] = scene_.bodies.at(static_cast<std::size_t>(scene_.joint->femur.body)).name;
    }
    json["bodies"] = Json::array();
    for (const BodyDescription& body : scene_.bodies) json["bodies"].push_back(body.name);
    json["moving"] = scene_.bodies.at(static_cast<std::size_t>(scene_.moving_body())).name;
  }

  void add_elements(Json& json) const {
    json["contacts"] = json["ligaments"] = Json::array();
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i) {
      json["contacts"].push_back(
          {{"name", scene_.contacts[i].name},
           {"force", series([&](const PoseResult& p) { return p.contacts[i].force; })}});
    }
    for (std::size_t i = 0; i < scene_.ligaments.size(); ++i) {
      json["ligaments"].push_back(
          {{"name", scene_.ligaments[i].name},
           {"strain", series([&](const PoseResult& p) { return p.ligaments[i].strain; })},
           {"force", series([&](const PoseResult& p) { return p.ligaments[i].force; })}});
    }
    const StrainScale strain = strain_scale(run_);
    json["strain_top"] = strain.top;
    json["greatest_strain"] = strain.greatest;
  }

  void add_pressures(Json& json) const {
    const ViewerPressures pressures = viewer_pressures(run_, shapes_, shown_);
    if (!(pressures.top > 0)) return;
    json["pressure"]["top"] = pressures.top;
    for (const ViewerPressures::OfSurface& surface : pressures.surfaces)
      json["pressure"]["surfaces"].push_back(
          {{"name", surface.name}, {"levels", base64(surface.levels)}});
  }

  const Run& run_;
  const Scene& scene_;
  std::vector<ShownPose> shown_;
  ShapeOptions shapes_;
};

}  // namespace

std::string viewer_section(const Run& run, const std::string& file) {
  if (count_with_place(run.sweep) == 0) return "";
  if (viewer_script().empty()) {
    return section("view", "In three dimensions",
                   "<p>This condyle was built without the 3-D view.</p>\n");
  }
  ShapeOptions options;
  options.bone_triangles = kBoneTriangles;
  const std::string model = base64(glb_of_run(run, file, options));
  std::string body = kMarkup;
  body += "<script type=\"application/json\" id=\"viewer-data\">" +
          script_safe(ViewerData(run, file, options).text()) + "</script>\n";
  body += "<script type=\"text/plain\" id=\"viewer-model\">" + model + "</script>\n";
  body += "<script>" + std::string(viewer_script()) + "</script>\n";
  return section("view", "In three dimensions", body);
}

}  // namespace condyle
