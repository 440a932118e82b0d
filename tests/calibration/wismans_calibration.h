#pragma once

/// The Wismans-type knee in tests of laxity: unloaded, drawer of 100 N, varus and valgus of 10 N m,
/// rotation of 5 N m, each at half and at full load, both ways, at 0, 15, 30, 60 and 90 deg: 325 rows that
/// are fitted; at 45 and 75 deg three quarters of the load, predicted only. What is measured is what the
/// knee answers with strains that are drawn from their prior.

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "condyle/calibration/free_parameter.h"
#include "condyle/calibration/predictions.h"
#include "condyle/design/normal_draws.h"
#include "condyle/elements/joint_table.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"

namespace condyle::test {

inline constexpr const char* kWismansLoads = R"(
[[load]]
name = "drawer"
body = "tibia"
kind = "force"
vector = [0, 1, 0]
at = [0, 0, 213]
follows = "body"

[[load]]
name = "varus"
body = "tibia"
kind = "moment"
vector = [0, 1, 0]
follows = "body"

[[load]]
name = "twist"
body = "tibia"
kind = "moment"
vector = [0, 0, 1]
follows = "body"

[calibrate]
measurements = "knee.csv"
moment = "N m"

[[calibrate.load]]
name = "anterior"
load = "drawer"

[[calibrate.load]]
name = "varus"
load = "varus"

[[calibrate.load]]
name = "internal"
load = "twist"

[[calibrate.parameter]]
of = "*"
what = "reference_strain"
prior_sd = PRIOR
)";

/// To be read in a folder where knee.csv is.
inline std::string wismans_text(double prior_sd) {
  const std::filesystem::path file =
      std::filesystem::path(CONDYLE_SOURCE_DIR) / "data/wismans-type/knee.toml";
  std::string loads = kWismansLoads;
  loads.replace(loads.find("PRIOR"), 5, fmt::format("{:.17g}", prior_sd));
  return read_scene(file).text + loads;
}

/// A pose of the table, five rows each.
struct WismansPose {
  double flexion;  ///< [deg]
  const char* load;
  double level;
  bool fitted;
};

inline std::vector<WismansPose> wismans_poses() {
  const std::pair<const char*, double> loads[] = {
      {"anterior", 100}, {"varus", 10}, {"internal", 5}};
  std::vector<WismansPose> poses;
  for (const double flexion : {0., 15., 30., 60., 90.}) {
    poses.push_back({flexion, "none", 0, true});
    for (const auto& [load, most] : loads)
      for (const double part : {-1., -0.5, 0.5, 1.})
        poses.push_back({flexion, load, part * most, true});
  }
  for (const double flexion : {45., 75.})
    for (const auto& [load, most] : loads)
      for (const double part : {-0.75, 0.75}) poses.push_back({flexion, load, part * most, false});
  return poses;
}

/// `values` [inside] in the order of poses, then of the five coordinates that are free; sd 0.5 mm and
/// 0.5 deg.
inline void write_wismans_table(const std::filesystem::path& file, const Eigen::VectorXd& values) {
  std::string text = "specimen,test,flexion,load,level,coordinate,value,sd,use\n";
  Eigen::Index i = 0;
  for (const WismansPose& pose : wismans_poses())
    for (std::size_t c = 1; c < kJointCoordinates.size(); ++c, ++i)
      text += fmt::format("k1,{}{},{},{},{},{},{:.17g},0.5,{}\n", pose.load, pose.flexion,
                          pose.flexion, pose.load, pose.level, kJointCoordinates[c].name,
                          values[i] * (kJointCoordinates[c].angle ? 180 / M_PI : 1),
                          pose.fitted ? "fit" : "test");
  std::ofstream(file) << text;
}

/// That knee with a truth and what is measured of it.
struct WismansCase {
  /// Writes knee.csv into the folder. `noise`: of what is measured, in standard deviations of 0.5.
  WismansCase(const std::filesystem::path& folder, double prior_sd, double noise) {
    const auto rows = static_cast<Eigen::Index>(5 * wismans_poses().size());
    write_wismans_table(folder / "knee.csv", Eigen::VectorXd::Zero(rows));
    scene = parse_scene(wismans_text(prior_sd), folder / "knee.toml");
    surfaces = fit_surfaces(scene);
    table = read_measurements(scene);
    meshes.resize(scene.bodies.size());
    parameters = free_parameters(scene, meshes, table);
    truth = 0.03 * normal_draws(5, DrawsFor::kStart, 1, 12);
    Predictions predictions(scene, surfaces, table, parameters);
    EXPECT_TRUE(predictions.evaluate(truth, exact, nullptr)) << predictions.failure();
    Eigen::VectorXd measured = exact;
    const Eigen::VectorXd draws = normal_draws(5, DrawsFor::kNoise, 1, rows);
    for (Eigen::Index i = 0; i < rows; ++i)
      measured[i] += noise * draws[i] * table.rows[static_cast<std::size_t>(i)].sd;
    write_wismans_table(folder / "knee.csv", measured);
    table = read_measurements(scene);
  }

  Scene scene;
  std::vector<FittedSurface> surfaces;
  std::vector<TriangleMesh> meshes;
  MeasurementTable table;
  std::vector<FreeParameter> parameters;
  Eigen::VectorXd truth, exact;
};

}  // namespace condyle::test
