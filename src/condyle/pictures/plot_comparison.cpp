#include "condyle/pictures/plot_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "condyle/compare/laxity.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

constexpr double kDegrees = 180 / M_PI;
constexpr std::size_t kMostPerPanel = 8;  ///< curves of ours, each with one of the reference
constexpr const char* kDashed = " (dashed: Wismans' model)";

Chart chart_of(const Run& run, const std::string& what) {
  return {run.scene.title, what, swept_quantity(run).axis, {}};
}

std::vector<double> swept_values(const Run& run) {
  const double per_value = swept_quantity(run).axis_per_inside;
  std::vector<double> values;
  for (const PoseResult& pose : run.sweep.poses) values.push_back(per_value * pose.value);
  return values;
}

bool carries(const ComparedQuantity& quantity) {
  const double least = quantity.units == "N" ? 0.5 : 1e-6;
  const auto some = [least](double value) { return std::abs(value) > least; };
  const std::vector<double>&a = quantity.of(Variant::kOurs), &b = quantity.of(Variant::kReference);
  return std::any_of(a.begin(), a.end(), some) || std::any_of(b.begin(), b.end(), some);
}

/// The contact whose force the quantity is; none for other quantities.
std::optional<std::size_t> contact_of_force(const Scene& scene, const ComparedQuantity& quantity) {
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    if (quantity.name == scene.contacts[i].name + " contact force") return i;
  return std::nullopt;
}

/// The contact whose place on the tibia the quantity is; none for other quantities.
std::optional<std::size_t> contact_of_place(const Scene& scene, const ComparedQuantity& quantity) {
  for (std::size_t i = 0; i < scene.contacts.size(); ++i)
    if (quantity.name.starts_with(scene.contacts[i].name + " contact, ")) return i;
  return std::nullopt;
}

/// Without what the label of the axis says already: "medial contact force" is medial.
std::string short_title(const Scene& scene, const ComparedQuantity& quantity) {
  if (const auto contact = contact_of_force(scene, quantity)) return scene.contacts[*contact].name;
  if (const auto contact = contact_of_place(scene, quantity)) {
    const std::string& name = scene.contacts[*contact].name;
    return name + quantity.name.substr(name.size() + std::string(" contact").size());
  }
  const std::string force = " force";
  const std::size_t size = quantity.name.size();
  return quantity.name.substr(0, quantity.name.ends_with(force) ? size - force.size() : size);
}

/// The quantities that `which` takes, each with a curve of ours and one of the reference.
Panel both(const Run& run,
           const std::string& label,
           const std::function<bool(const ComparedQuantity&)>& which) {
  Panel panel{label, {}};
  int color = 0;
  for (const ComparedQuantity& quantity : run.comparison()->quantities) {
    if (!which(quantity) || !carries(quantity)) continue;
    Curve ours{short_title(run.scene, quantity), swept_values(run), quantity.of(Variant::kOurs),
               color};
    Curve reference{"", swept_values(run), quantity.of(Variant::kReference), color, true};
    if (const auto contact = contact_of_place(run.scene, quantity)) {
      ours = broken_at_jumps(std::move(ours), run.sweep, *contact);
      reference = broken_at_jumps(std::move(reference), run.comparison()->reference, *contact);
    }
    panel.curves.push_back(std::move(ours));
    panel.curves.push_back(std::move(reference));
    ++color;
  }
  return panel;
}

/// Full panels are divided, so that no colour has to stand for two curves.
std::vector<Panel> divided(const Panel& panel) {
  std::vector<Panel> parts;
  const std::size_t most = 2 * kMostPerPanel;
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    if (i % most == 0) parts.push_back({panel.y_label, {}, panel.from_zero, panel.floor});
    parts.back().curves.push_back(panel.curves[i]);
    parts.back().curves.back().color = static_cast<int>(i % most / 2);
  }
  return parts;
}

/// What the engine does with one thing of the reference model at a time.
Panel switched(const Run& run, const std::string& name) {
  Panel panel;
  for (const ComparedQuantity& quantity : run.comparison()->quantities) {
    if (quantity.name != name) continue;
    panel.y_label = fmt::format("{} [{}]", name, quantity.units == "deg" ? "°" : quantity.units);
    const std::vector<std::pair<Variant, std::string>> curves = {
        {Variant::kOurs, "ours"},
        {Variant::kSurfaces, "ours + surfaces"},
        {Variant::kSprings, "ours + springs"},
        {Variant::kClosed, "ours + closed"},
        {Variant::kReference, "Wismans' model"}};
    for (const auto& [variant, title] : curves) {
      panel.curves.push_back(
          {title, swept_values(run), quantity.of(variant), -1, variant == Variant::kReference});
    }
  }
  return panel;
}

void add_chart(std::vector<NamedChart>& charts,
               const Run& run,
               const std::string& name,
               const std::string& what,
               std::vector<Panel> panels) {
  NamedChart chart{name, chart_of(run, what)};
  for (Panel& panel : panels)
    if (!panel.curves.empty()) chart.chart.panels.push_back(std::move(panel));
  if (!chart.chart.panels.empty()) charts.push_back(std::move(chart));
}

}  // namespace

std::vector<NamedChart> comparison_charts(const Run& run) {
  std::vector<NamedChart> charts;
  if (!run.comparison()) return charts;
  const auto is_place = [&](const ComparedQuantity& q) {
    return contact_of_place(run.scene, q).has_value();
  };
  const auto is_contact_force = [&](const ComparedQuantity& q) {
    return contact_of_force(run.scene, q).has_value();
  };
  add_chart(charts, run, "compare_joint", std::string("joint coordinates") + kDashed,
            {both(run, "Rotation [°]", [](const auto& q) { return q.units == "deg"; }),
             both(run, "Translation [mm]",
                  [&](const auto& q) { return q.units == "mm" && !is_place(q); })});
  add_chart(charts, run, "compare_contacts", std::string("contacts") + kDashed,
            {both(run, "Contact force [N]", is_contact_force),
             both(run, "Contact on the tibia [mm]", is_place)});
  add_chart(charts, run, "compare_ligaments", std::string("ligament forces") + kDashed,
            divided(both(run, "Ligament force [N]",
                         [&](const auto& q) { return q.units == "N" && !is_contact_force(q); })));
  add_chart(charts, run, "compare_moment", std::string("flexion moment") + kDashed,
            {both(run, "Flexion moment [N mm]", [](const auto& q) { return q.units == "N mm"; })});
  add_chart(charts, run, "compare_parts", "parts of Wismans' model, one at a time",
            {switched(run, "internal rotation"), switched(run, "adduction"),
             switched(run, "anterior drawer")});
  return charts;
}

Chart laxity_chart(const Run& run) {
  const SweptQuantity swept = swept_quantity(run);
  const std::vector<LaxityCurve>& curves = run.laxity()->curves;
  const bool angle = loaded_coordinate(run.scene) < 3;
  const bool both_models = !curves.empty() && curves[0].reference;
  Chart chart{
      run.scene.title, std::string("laxity") + (both_models ? kDashed : ""), swept.axis, {}};
  std::vector<double> loads;
  for (const double scale : run.scene.sweep->values) loads.push_back(swept.axis_per_inside * scale);
  for (const bool cut : {false, true}) {
    Panel panel{fmt::format("{} [{}]", cut ? "Ligaments cut" : "Intact", angle ? "°" : "mm"), {}};
    int color = 0;
    for (const LaxityCurve& curve : curves) {
      if (curve.cut != cut) continue;
      panel.curves.push_back(
          {fmt::format("{:g}°", std::round(1e4 * curve.flexion * kDegrees) / 1e4), loads,
           displacements(run.scene, curve.ours), color, false});
      if (curve.reference)
        panel.curves.push_back(
            {"", loads, displacements(run.scene, *curve.reference), color, true});
      ++color;
    }
    if (!panel.curves.empty()) chart.panels.push_back(std::move(panel));
  }
  return chart;
}

}  // namespace condyle
