#pragma once

/// The Wismans-type knee in tests of laxity: its loads, the table of a laboratory that measures all
/// that moves, and the numbers that may be free.

#include <string>
#include <vector>

#include "condyle/calibration/free_parameter.h"
#include "condyle/math/degree.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle::test {

/// Loads of the tests of laxity on the tibia: "anterior" [N] at the plateau, "varus" and "internal"
/// [N mm], by force; "drawn" holds the anterior drawer instead [mm].
inline void add_tests_of_laxity(Scene& scene) {
  const int tibia = scene.moving_body();
  const auto add = [&](const char* name, bool moment, const Eigen::Vector3d& vector) {
    LoadDescription load;
    load.name = name;
    load.body = tibia;
    load.moment = moment;
    load.vector = vector;
    load.at = scene.joint->tibia.origin;
    load.follows_body = true;
    scene.loads.push_back(load);
    scene.calibration->loads.push_back({name, false, static_cast<int>(scene.loads.size()) - 1});
  };
  const double side = scene.joint->side == Side::kRight ? 1 : -1;
  add("anterior", false, {0, 100, 0});
  add("varus", true, {0, side * 10000, 0});
  add("internal", true, {0, 0, side * 5000});
  ConditionDescription drawn;
  drawn.name = "drawn";
  drawn.kind = ConditionKind::kAnteriorDrawer;
  scene.conditions.push_back(drawn);
  scene.calibration->loads.push_back(
      {"drawn", true, static_cast<int>(scene.conditions.size()) - 1});
}

inline Scene measured_knee() {
  Scene scene =
      read_scene(std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/wismans-type/knee.toml");
  scene.calibration.emplace();
  scene.calibration->flexion = 0;
  add_tests_of_laxity(scene);
  return scene;
}

/// Rows of all joint coordinates but the flexion at one pose. `load`: of CalibrationDescription, -1: none.
inline void add_coordinates(
    const std::string& test, double flexion, int load, double level, MeasurementTable& table) {
  for (const std::size_t coordinate : {1, 2, 3, 4, 5}) {
    Measurement row;
    row.line = static_cast<int>(table.rows.size()) + 2;
    row.test = test;
    row.flexion = flexion;
    row.load = load;
    row.level = level;
    row.index = coordinate;
    row.sd = coordinate < 3 ? 0.5 * kDegree : 0.5;
    table.rows.push_back(row);
  }
}

/// 65 poses, 325 rows: at each flexion unloaded, and anterior, varus and internal at half and full level
/// both ways.
inline MeasurementTable table_of_laxity(const Scene& scene) {
  MeasurementTable table;
  table.file = "knee.csv";
  for (const double flexion : {0.0, 15.0, 30.0, 60.0, 90.0}) {
    add_coordinates("passive", flexion * kDegree, -1, 0, table);
    for (const int load : {0, 1, 2}) {
      const double full = scene.loads[static_cast<std::size_t>(load)].vector.norm();
      for (const double part : {-1.0, -0.5, 0.5, 1.0})
        add_coordinates(scene.loads[static_cast<std::size_t>(load)].name, flexion * kDegree, load,
                        part * full, table);
    }
  }
  return table;
}

inline FreeParameter free_number(const std::string& name,
                                 const ModelParameter& number,
                                 double prior_sd,
                                 bool logarithmic = false) {
  FreeParameter parameter;
  parameter.name = name;
  parameter.units.assign(1, '1');
  parameter.moves = {{number, 1.0}};
  parameter.logarithmic = logarithmic;
  parameter.prior_sd = prior_sd;
  return parameter;
}

/// One of each ligament.
inline std::vector<FreeParameter> free_strains(const Scene& scene) {
  std::vector<FreeParameter> parameters;
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i)
    parameters.push_back(free_number(scene.ligaments[i].name + ".reference_strain",
                                     {ParameterKind::kReferenceStrain, i}, 0.03));
  return parameters;
}

}  // namespace condyle::test
