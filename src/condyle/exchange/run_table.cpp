#include "condyle/exchange/run_table.h"

#include <fmt/format.h>

#include <functional>
#include <utility>

#include "condyle/equilibrium/sweep_sensitivities.h"
#include "condyle/math/no_number.h"
#include "condyle/results/run_layout.h"
#include "condyle/results/sensitivity_group.h"
#include "condyle/study/mesh_uncertainty.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

class Columns {
 public:
  Columns(const Run& run, const std::vector<ShownPose>& shown)
      : run_(run), scene_(run.scene), shown_(shown) {}

  [[nodiscard]] std::vector<TableColumn> all() {
    add_pose();
    add_joint();
    for (std::size_t i = 0; i < scene_.contacts.size(); ++i) add_contact(i);
    for (std::size_t i = 0; i < scene_.ligaments.size(); ++i) add_ligament(i);
    for (std::size_t i = 0; i < scene_.conditions.size(); ++i) add_condition(i);
    if (run_.sensitivities) add_sensitivities();
    if (run_.uncertainty) add_uncertainty();
    add_solver();
    return std::move(columns_);
  }

 private:
  using OfPose = std::function<double(const PoseResult&)>;
  void add(const std::string& quantity,
           const std::string& name,
           const std::string& component,
           const std::string& unit,
           const OfPose& value) {
    TableColumn column{quantity, name, component, unit, {}};
    for (const ShownPose& shown : shown_)
      column.values.push_back(value(run_.sweep.poses[shown.index]));
    columns_.push_back(std::move(column));
  }

  using VectorOfPose = std::function<Vector3d(const PoseResult&)>;
  void add_vector(const std::string& quantity,
                  const std::string& name,
                  const std::string& component,
                  const std::string& unit,
                  const VectorOfPose& value) {
    for (int k = 0; k < 3; ++k) {
      add(quantity, name, component + "_" + "xyz"[k], unit,
          [&](const PoseResult& pose) { return value(pose)[k]; });
    }
  }

  void add_pose() {
    if (scene_.moving_body() < 0) return;
    const std::string& body = scene_.bodies[static_cast<std::size_t>(scene_.moving_body())].name;
    add_vector("pose", body, "translation", "mm", [](const PoseResult& p) { return p.X_BA.p; });
    for (int i = 0; i < 3; ++i) {
      add_vector("pose", body, fmt::format("rotation_{}", "xyz"[i]), "1",
                 [&](const PoseResult& p) -> Vector3d { return p.X_BA.R.row(i); });
    }
  }

  void add_joint() {
    if (!scene_.joint) return;
    for (const auto& column : kJointColumns) {
      add("joint", "knee", column.name, column.units,
          [&](const PoseResult& p) { return p.joint.*column.member / column.unit; });
    }
  }

  void add_contact(std::size_t i) {
    const std::string& name = scene_.contacts[i].name;
    add("contact", name, "closed", "1",
        [&](const PoseResult& p) { return p.contacts[i].closed ? 1 : 0; });
    add("contact", name, "points", "1", [&](const PoseResult& p) {
      return p.contacts[i].closed ? static_cast<double>(p.contacts[i].points.size()) : 0;
    });
    add("contact", name, "force", "N", [&](const PoseResult& p) { return p.contacts[i].force; });
    add_vector("contact", name, "force", "N",
               [&](const PoseResult& p) { return force_on_moving_body(p.contacts[i]); });
    add_vector("contact", name, "place", "mm",
               [&](const PoseResult& p) { return force_place(p.contacts[i]); });
    add("contact", name, "gap", "mm", [&](const PoseResult& p) {
      const ContactPointResult* point = strongest_point(p.contacts[i]);
      return point ? point->gap : kNoNumber;
    });
    add("contact", name, "beyond_edge", "mm",
        [&](const PoseResult& p) { return beyond_edge(p.contacts[i]); });
    if (scene_.contacts[i].layer) add_layer(i);
  }

  /// NaN, and so no row, where nothing is pressed.
  void add_layer(std::size_t i) {
    const auto add_number = [&](const char* component, const char* unit,
                                double LayerResult::*member) {
      add("contact", scene_.contacts[i].name, component, unit, [&, member](const PoseResult& p) {
        const std::optional<LayerResult>& layer = p.contacts[i].layer;
        return layer ? (*layer).*member : kNoNumber;
      });
    };
    add_number("area", "mm^2", &LayerResult::area);
    add_number("pressure_mean", "N/mm^2", &LayerResult::mean_pressure);
    add_number("pressure_max", "N/mm^2", &LayerResult::peak_pressure);
    add_number("depth", "mm", &LayerResult::deepest);
    add_number("energy", "N mm", &LayerResult::energy);
    add_number("lost_force", "1", &LayerResult::lost);
    add_number("lateral_ratio", "1", &LayerResult::lateral);
    add_number("error", "1", &LayerResult::error);
  }

  void add_ligament(std::size_t i) {
    for (const auto& column : kLigamentColumns) {
      if (column.member == &LigamentResult::strain && !has_strain(scene_.ligaments[i].law))
        continue;
      add("ligament", scene_.ligaments[i].name, column.name, column.units,
          [&](const PoseResult& p) { return p.ligaments[i].*column.member / column.unit; });
    }
  }

  void add_condition(std::size_t i) {
    const ConditionDescription& condition = scene_.conditions[i];
    const bool angle = is_angle(condition.kind);
    add("condition", condition.name, "value", angle ? "deg" : "mm",
        [&](const PoseResult& p) { return p.conditions[i].value / (angle ? kDegree : 1); });
    add("condition", condition.name, "multiplier", angle ? "N mm" : "N",
        [&](const PoseResult& p) { return p.conditions[i].multiplier; });
  }

  /// Of each output by each number: quantity "sensitivity", the number's name as component.
  void add_sensitivities() {
    const SweepSensitivities& all = *run_.sensitivities;
    for (std::size_t i = 0; i < all.outputs.size(); ++i)
      for (std::size_t j = 0; j < all.parameters.size(); ++j) {
        TableColumn column{"sensitivity",
                           all.outputs[i].place,
                           all.parameters[j].name,
                           all.outputs[i].unit.name + "/" + all.parameters[j].unit.name,
                           {}};
        for (const ShownPose& shown : shown_)
          column.values.push_back(shown_derivative(all, shown.index, i, j));
        columns_.push_back(std::move(column));
      }
  }

  /// Quantity "uncertainty": standard deviation, given the meshes.
  void add_uncertainty() {
    const MeshUncertainty& all = *run_.uncertainty;
    for (std::size_t i = 0; i < all.outputs.size(); ++i) {
      const Unit& unit = all.outputs[i].unit;
      TableColumn column{"uncertainty", all.outputs[i].place, "sd", unit.name, {}};
      for (const ShownPose& shown : shown_)
        column.values.push_back(all.sd[i][shown.index] / unit.factor);
      columns_.push_back(std::move(column));
    }
  }

  void add_solver() {
    add("solver", "", "status", "1",
        [](const PoseResult& p) { return static_cast<double>(p.status); });
    add("solver", "", "stable", "1",
        [](const PoseResult& p) { return static_cast<double>(p.stability); });
    add("solver", "", "lowest_stiffness", "N/mm",
        [](const PoseResult& p) { return p.lowest_stiffness; });
    add("solver", "", "residual", "N", [](const PoseResult& p) { return p.residual; });
  }

  const Run& run_;
  const Scene& scene_;
  const std::vector<ShownPose>& shown_;
  std::vector<TableColumn> columns_;
};

}  // namespace

std::vector<TableColumn> run_columns(const Run& run, const std::vector<ShownPose>& shown) {
  return Columns(run, shown).all();
}

}  // namespace condyle
