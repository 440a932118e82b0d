/// The Lenhart knee on elastic layers: positions of equilibrium against another program's on the same
/// patches (linear law, E = 10 N/mm², ν = 0.45, 3 + 3 mm), where its contacts keep clear of the
/// edges of the patches.

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "condyle/contact/layer_contact.h"
#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/sweep.h"
#include "condyle/math/degree.h"
#include "condyle/scene_file/read_scene.h"
#include "support/layer_fixture.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

const fs::path kKnee = fs::path(CONDYLE_SOURCE_DIR) / "../shared/specimens/lenhart2015/knee.toml";

using Row = std::map<std::string, double>;

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

std::vector<Row> published_poses() {
  std::ifstream file(test::kLayer / "layered_knee_poses_100N.csv");
  std::vector<std::string> names;
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    Row row;
    for (std::size_t i = 0; i < cells.size(); ++i) row[names[i]] = std::atof(cells[i].c_str());
    rows.push_back(row);
  }
  return rows;
}

Model layered_knee(const Scene& scene, const LayerOptions& options) {
  std::vector<FittedSurface> surfaces;
  for (const SurfaceDescription& surface : scene.surfaces)
    surfaces.push_back(
        {std::make_shared<const Patch>(test::layer_patch(surface.name)), std::nullopt});
  Model model = build_model(scene, surfaces);
  for (ContactPair& pair : model.pairs) {
    pair.elastic_B = pair.elastic_A = ElasticSurface{10, 0.45, 3};
    pair.mode = ContactMode::kOpen;
    pair.law = layer_contact(options);
  }
  return model;
}

TEST(LayeredKnee, SitsWhereAnotherProgramFoundIt) {
  if (!fs::exists(test::kLayer) || !fs::exists(kKnee)) GTEST_SKIP() << "no specimens here";
  const Scene scene = read_scene(kKnee);
  EquilibriumSolver solver(
      layered_knee(scene, {.pressure = PressureLaw::kLinear, .tolerance = 2e-4}));
  std::vector<double> flexions;
  std::vector<Row> rows;
  for (const Row& row : published_poses()) {
    if (row.at("flexion_deg") < 40 || row.at("flexion_deg") > 60) continue;
    rows.push_back(row);
    flexions.push_back(kDegree * row.at("flexion_deg"));
  }
  ASSERT_EQ(rows.size(), 5U);
  const SweepResult result = sweep(solver, swept_of(*scene.sweep), flexions);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const PoseResult& pose = result.poses[i];
    ASSERT_TRUE(pose.converged()) << rows[i]["flexion_deg"] << ": " << pose.reason;
    EXPECT_NEAR(pose.joint.adduction / kDegree, rows[i]["layer_adduction_deg"], 0.02);
    EXPECT_NEAR(pose.joint.internal_rotation / kDegree, rows[i]["layer_internal_rotation_deg"],
                0.02);
    EXPECT_NEAR(pose.joint.lateral_shift, rows[i]["layer_lateral_shift_mm"], 0.01);
    EXPECT_NEAR(pose.joint.anterior_drawer, rows[i]["layer_anterior_drawer_mm"], 0.01);
    EXPECT_NEAR(pose.joint.distraction, rows[i]["layer_distraction_mm"], 0.01);
    for (std::size_t c = 0; c < 2; ++c) {
      const std::string name = scene.contacts[c].name;
      ASSERT_TRUE(pose.contacts[c].closed && pose.contacts[c].layer);
      const double force = rows[i]["layer_" + name + "_force_N"];
      EXPECT_NEAR(pose.contacts[c].force, force, 0.005 * force);
      const LayerResult& layer = *pose.contacts[c].layer;
      EXPECT_NEAR(layer.area, rows[i]["layer_" + name + "_area_mm2"], 0.03 * layer.area);
      EXPECT_NEAR(layer.peak_pressure, rows[i]["layer_" + name + "_pmax_MPa"],
                  0.01 * layer.peak_pressure);
      EXPECT_LE(layer.error, 2e-4);
    }
  }
}

// At a fixed load depths go with E^-1/2: four times the modulus halves the way from the limit.
TEST(LayeredKnee, FourTimesTheModulusHalvesTheDepth) {
  if (!fs::exists(test::kLayer) || !fs::exists(kKnee)) GTEST_SKIP() << "no specimens here";
  const Scene scene = read_scene(kKnee);
  std::vector<double> distractions;
  for (const double modulus : {10., 40., 160., 640.}) {
    Model model = layered_knee(scene, {});
    for (ContactPair& pair : model.pairs)
      pair.elastic_B->modulus = pair.elastic_A->modulus = modulus;
    EquilibriumSolver solver(model);
    const SweepResult result = sweep(solver, swept_of(*scene.sweep), {30 * kDegree});
    ASSERT_TRUE(result.poses[0].converged()) << modulus << ": " << result.poses[0].reason;
    distractions.push_back(result.poses[0].joint.distraction);
  }
  for (std::size_t i = 0; i + 2 < distractions.size(); ++i)
    EXPECT_NEAR(
        (distractions[i + 1] - distractions[i]) / (distractions[i + 2] - distractions[i + 1]), 2,
        0.1);
}

}  // namespace
}  // namespace condyle
