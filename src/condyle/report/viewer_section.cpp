#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "condyle/elements/force_law.h"
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
<div class="pick" role="group" aria-label="curves of a ligament or a contact" hidden><p class="note">Curves of a ligament or a contact: click it in the view, or here; Escape ends it.</p></div>
<div class="picked" role="region" aria-label="curves of what is picked" hidden></div>
</div>
)";

struct Pressed {
  double area = 0, most = 0;  ///< [mm²], [MPa]
};

/// Nothing of a contact of which no pressure is known, as of an open one.
std::optional<Pressed> pressure_of(const ContactResult& contact) {
  if (contact.layer) return Pressed{contact.layer->area, contact.layer->peak_pressure};
  const ContactPointResult* point = contact.closed ? strongest_point(contact) : nullptr;
  if (point == nullptr || !point->hertz) return std::nullopt;
  const auto& axes = point->hertz->semi_axes;
  return Pressed{M_PI * axes[0] * axes[1], point->hertz->peak_pressure};
}

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
    json["coordinates"] = coordinates();
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

  [[nodiscard]] Json coordinates() const {
    Json rows = Json::array();
    if (!scene_.joint) return rows;
    for (std::size_t k = 0; k < kJointColumns.size(); ++k) {
      const auto& column = kJointColumns[k];
      if (is_swept(run_, k)) continue;
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

  /// Of a contact its force and, where it has them, area and greatest pressure: of its layers, or
  /// those of Hertz's theory.
  [[nodiscard]] Json contact(std::size_t i) const {
    const ContactDescription& described = scene_.contacts[i];
    Json json = {{"name", described.name}, {"surfaces", Json::array()}};
    for (const int surface : described.surfaces)
      if (surface >= 0 && static_cast<std::size_t>(surface) < scene_.surfaces.size())
        json["surfaces"].push_back(scene_.surfaces[static_cast<std::size_t>(surface)].name);
    json["force"] = series([&](const PoseResult& p) { return p.contacts[i].force; });
    const bool pressed = std::any_of(shown_.begin(), shown_.end(), [&](const ShownPose& shown) {
      return pressure_of(run_.sweep.poses[shown.index].contacts[i]).has_value();
    });
    if (!pressed) return json;
    for (const auto& [key, part] :
         {std::pair{"area", &Pressed::area}, {"pressure", &Pressed::most}})
      json[key] = series([&, part = part](const PoseResult& p) {
        return pressure_of(p.contacts[i]).value_or(Pressed{}).*part;
      });
    return json;
  }

  [[nodiscard]] Json ligament(std::size_t i) const {
    const LigamentDescription& described = scene_.ligaments[i];
    Json json = {{"name", described.name}, {"has_strain", has_strain(described.law)}};
    for (const auto& column : kLigamentColumns)
      json[column.name] =
          series([&](const PoseResult& p) { return p.ligaments[i].*column.member; });
    return json;
  }

  void add_elements(Json& json) const {
    json["contacts"] = json["ligaments"] = Json::array();
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i) json["contacts"].push_back(contact(i));
    for (std::size_t i = 0; i < scene_.ligaments.size(); ++i)
      json["ligaments"].push_back(ligament(i));
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
