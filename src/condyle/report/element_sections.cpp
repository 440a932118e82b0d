#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/report/html.h"
#include "condyle/report/sections.h"
#include "condyle/results/run_view.h"

namespace condyle {
namespace {

using Poses = std::vector<PoseResult>;

std::vector<std::string> contact_row(const PoseResult& pose, std::size_t index, bool pressed) {
  const ContactResult& contact = pose.contacts[index];
  const ContactPointResult* point = strongest_point(contact);
  std::vector<std::string> row = {contact.closed ? "closed" : "open", number(contact.force, 1),
                                  fmt::format("{}", contact.closed ? contact.points.size() : 0)};
  for (Eigen::Index k = 0; k < 3; ++k)
    row.push_back(point != nullptr && contact.closed ? number(point->point_ground[k], 2) : "-");
  row.push_back(point != nullptr ? short_number(contact.closed ? 0 : point->gap) : "-");
  if (pressed) {
    const bool has = point != nullptr && point->hertz.has_value();
    row.push_back(has ? number(point->hertz->semi_axes[0], 2) : "-");
    row.push_back(has ? number(point->hertz->semi_axes[1], 2) : "-");
    row.push_back(has ? number(point->hertz->peak_pressure, 2) : "-");
  }
  return row;
}

bool any_place(const Poses& poses) { return std::any_of(poses.begin(), poses.end(), has_place); }

/// ", 2.8 mm beyond the edge"
std::string beyond_words(const PoseResult& pose, const ContactResult& contact) {
  const double beyond = pose.converged() ? 0 : beyond_edge(contact);
  return beyond > 0 ? fmt::format(", {:.2g} mm beyond the edge", beyond) : "";
}

bool has_pressure(const Poses& poses, std::size_t index) {
  return std::any_of(poses.begin(), poses.end(), [&](const PoseResult& pose) {
    if (!pose.converged()) return false;
    const ContactPointResult* point = strongest_point(pose.contacts[index]);
    return point != nullptr && point->hertz.has_value();
  });
}

HtmlTable contact_table(const Run& run, std::size_t index) {
  const SweptQuantity swept = swept_quantity(run);
  const bool pressed = has_pressure(run.sweep.poses, index);
  HtmlTable table{
      run.scene.contacts[index].name,
      {swept.heading(), "state", "force [N]", "points", "x [mm]", "y [mm]", "z [mm]", "gap [mm]"},
      {},
      {1}};
  if (pressed) {
    for (const char* head : {"ellipse a [mm]", "b [mm]", "peak pressure [N/mm²]"})
      table.columns.emplace_back(head);
  }
  for (const PoseResult& pose : run.sweep.poses) {
    if (!has_place(pose)) continue;
    std::vector<std::string> row = contact_row(pose, index, pressed);
    row.insert(row.begin(), at_value(swept, pose.value));
    row[1] += beyond_words(pose, pose.contacts[index]);
    table.rows.push_back(std::move(row));
    table.row_classes.emplace_back(pose.converged() ? "" : "failed");
  }
  return table;
}

/// The pose at which a ligament pulls most.
const PoseResult* hardest(const Poses& poses, std::size_t index) {
  const PoseResult* best = nullptr;
  for (const PoseResult& pose : poses) {
    if (!pose.converged()) continue;
    if (best == nullptr || pose.ligaments[index].force > best->ligaments[index].force) best = &pose;
  }
  return best;
}

std::vector<std::string> ligament_row(const Run& run,
                                      const SweptQuantity& swept,
                                      std::size_t index) {
  const PoseResult* most = hardest(run.sweep.poses, index);
  const std::string& ligament_name = run.scene.ligaments[index].name;
  if (most == nullptr) return {ligament_name, "-", "-", "-", "-", "-"};
  double low = 1e300, high = -1e300;
  int taut = 0, all = 0;
  for (const PoseResult& pose : run.sweep.poses) {
    if (!pose.converged()) continue;
    const LigamentResult& ligament = pose.ligaments[index];
    low = std::min(low, ligament.strain);
    high = std::max(high, ligament.strain);
    taut += ligament.force > 0 ? 1 : 0;
    ++all;
  }
  const double force = most->ligaments[index].force;
  const bool strained = has_strain(run.scene.ligaments[index].law);
  return {ligament_name,
          number(force, 1),
          force > 0 ? at_value(swept, most->value) : "-",
          strained ? number(100 * low, 1) : "-",
          strained ? number(100 * high, 1) : "-",
          fmt::format("{} of {}", taut, all)};
}

/// One number of each ligament at each pose.
HtmlTable ligament_table(const Run& run,
                         double LigamentResult::*part,
                         double factor,
                         const char* caption) {
  const SweptQuantity swept = swept_quantity(run);
  HtmlTable table{caption, {swept.heading()}, {}, {}};
  for (const LigamentDescription& ligament : run.scene.ligaments)
    table.columns.push_back(ligament.name);
  for (const PoseResult& pose : run.sweep.poses) {
    if (!has_place(pose)) continue;
    std::vector<std::string> row = {at_value(swept, pose.value)};
    for (std::size_t i = 0; i < pose.ligaments.size(); ++i) {
      const bool told = part != &LigamentResult::strain || has_strain(run.scene.ligaments[i].law);
      row.push_back(told ? number(factor * pose.ligaments[i].*part, 1) : "-");
    }
    table.rows.push_back(std::move(row));
    table.row_classes.emplace_back(pose.converged() ? "" : "failed");
  }
  return table;
}

}  // namespace

std::string contact_section(const Run& run) {
  if (!any_place(run.sweep.poses)) return "";
  std::string body;
  for (std::size_t i = 0; i < run.scene.contacts.size(); ++i) body += html(contact_table(run, i));
  if (!body.empty())
    body +=
        "<p class=\"note\">Places are those of the point with the greatest force, in the ground "
        "frame.</p>\n";
  return section("contacts", "Contacts", body);
}

std::string ligament_section(const Run& run) {
  if (!any_place(run.sweep.poses) || run.scene.ligaments.empty()) return "";
  const SweptQuantity swept = swept_quantity(run);
  HtmlTable table{"",
                  {"ligament", "greatest force [N]", "at " + swept.heading(), "least strain [%]",
                   "greatest strain [%]", "poses taut"},
                  {}};
  for (std::size_t i = 0; i < run.scene.ligaments.size(); ++i)
    table.rows.push_back(ligament_row(run, swept, i));
  const std::string each = html(ligament_table(run, &LigamentResult::force, 1, "Force [N]")) +
                           html(ligament_table(run, &LigamentResult::strain, 100, "Strain [%]"));
  return section("ligaments", "Ligaments", html(table) + details("Each pose", each));
}

}  // namespace condyle
