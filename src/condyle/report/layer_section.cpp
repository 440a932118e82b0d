#include <fmt/format.h>

#include <vector>

#include "condyle/report/html.h"
#include "condyle/report/sections.h"

namespace condyle {
namespace {

HtmlTable layer_table(const Run& run, std::size_t index) {
  const SweptQuantity swept = swept_quantity(run);
  HtmlTable table{
      run.scene.contacts[index].name,
      {swept.heading(), "force [N]", "area [mm²]", "mean pressure [MPa]", "greatest pressure [MPa]",
       "depth [mm]", "energy [N mm]", "λ/a", "error of the force [%]", "force lost at an edge [%]"},
      {}};
  for (const PoseResult& pose : run.sweep.poses) {
    if (!has_place(pose) || !pose.contacts[index].layer) continue;
    const LayerResult& layer = *pose.contacts[index].layer;
    table.rows.push_back({at_value(swept, pose.value), number(pose.contacts[index].force, 1),
                          number(layer.area, 1), number(layer.mean_pressure, 3),
                          number(layer.peak_pressure, 3), number(layer.deepest, 3),
                          number(layer.energy, 2), number(layer.lateral, 2),
                          short_number(100 * layer.error), short_number(100 * layer.lost)});
    table.row_classes.emplace_back(pose.converged() ? "" : "failed");
  }
  return table;
}

}  // namespace

std::string layer_section(const Run& run) {
  std::string body;
  for (std::size_t i = 0; i < run.scene.contacts.size(); ++i) {
    if (!run.scene.contacts[i].layer) continue;
    const HtmlTable table = layer_table(run, i);
    if (!table.rows.empty()) body += html(table);
  }
  if (!body.empty())
    body +=
        "<p class=\"note\">An elastic foundation: each point of a layer gives way on its own. "
        "Where "
        "λ/a, the length over which a layer gives way sideways over the radius of the area, is "
        "above "
        "1, pressures are numbers of the model rather than stresses of the tissue.</p>\n";
  return section("layers", "Pressure of the layers", body);
}

}  // namespace condyle
