/// Derivatives as the program writes them, against differences of sweeps that the program does anew
/// on scenes with another number.

#include <cmath>
#include <functional>

#include "app/run_program.h"
#include "condyle/equilibrium/sweep_sensitivities.h"
#include "condyle/results/run_file.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using test::Outcome;

const std::string kKnee =
    with(test::contents(fs::path(CONDYLE_SOURCE_DIR) / "data/wismans-type/knee.toml"),
         "step = 5",
         "step = 30");

class SensitivitiesCommand : public test::CommandLine {
 protected:
  [[nodiscard]] condyle::Run swept(const std::string& text) const {
    write("knee.toml", text);
    const Outcome outcome = run("sweep knee.toml -o run.h5 --quiet");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_run(at("run.h5"));
  }

  /// Of the program's results, by one number that `scene` writes differently by `by`.
  void expect_differences(const std::string& name,
                          double h,
                          const std::function<std::string(double by)>& scene) const {
    const condyle::Run asked = swept(kKnee + "sensitivities = [\"" + name + "\"]\n");
    ASSERT_NE(asked.sensitivities, nullptr);
    std::vector<std::pair<condyle::Run, double>> moved;
    for (const auto& [steps, weight] :
         {std::pair{1, 8.0}, std::pair{-1, -8.0}, std::pair{2, -1.0}, std::pair{-2, 1.0}})
      moved.emplace_back(swept(scene(steps * h)), weight / (12 * h));
    const SweepSensitivities& s = *asked.sensitivities;
    for (std::size_t pose = 0; pose < s.by_pose.size(); ++pose)
      for (std::size_t i = 0; i < s.outputs.size(); ++i) {
        double expected = 0, greatest = 0;
        for (const auto& [other, weight] : moved)
          expected += weight * value_of(s.outputs[i].output, other.sweep.poses[pose]);
        for (std::size_t k = 0; k < s.outputs.size(); ++k)
          if (s.outputs[k].unit.name == s.outputs[i].unit.name)
            greatest =
                std::max(greatest, std::abs(s.by_pose[pose](static_cast<Eigen::Index>(k), 0)));
        EXPECT_NEAR(s.by_pose[pose](static_cast<Eigen::Index>(i), 0), expected,
                    1e-6 * greatest + 1e-9)
            << name << " on " << s.outputs[i].place << " at pose " << pose;
      }
  }
};

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

TEST_F(SensitivitiesCommand, OfASlackLengthAreDifferencesOfSweeps) {
  expect_differences("aPCL.slack_length", 1e-3,
                     [](double by) { return with(kKnee, "33.3226701", number(33.3226701 + by)); });
}

TEST_F(SensitivitiesCommand, OfAStiffnessAreDifferencesOfSweeps) {
  expect_differences("aACL.stiffness", 1,
                     [](double by) { return with(kKnee, "2562.99025", number(2562.99025 + by)); });
}

TEST_F(SensitivitiesCommand, OfAPrescribedFlexionAreDifferencesOfSweeps) {
  expect_differences("flexion.value", 1e-3 * M_PI / 180, [](double by) {
    const std::string degrees = number(by * 180 / M_PI);
    std::string text = with(kKnee, "from = 0", "from = " + degrees);
    return with(text, "to = 90", "to = " + number(90 + by * 180 / M_PI));
  });
}

TEST_F(SensitivitiesCommand, AreWrittenByTheirNamesWithUnits) {
  const condyle::Run asked =
      swept(kKnee + "sensitivities = [\"medial plateau.shift\", \"*.insertion.tibia\"]\n");
  const SweepSensitivities& s = *asked.sensitivities;
  ASSERT_EQ(s.parameters.size(), 3 * (1 + asked.scene.ligaments.size()));
  EXPECT_EQ(s.parameters[2].name, "medial plateau.shift.z");
  EXPECT_EQ(s.one_sided, std::vector<std::string>(asked.sweep.poses.size(), ""));
  for (const Eigen::MatrixXd& J : s.by_pose) EXPECT_TRUE(J.allFinite());
  const Outcome csv = run("export run.h5 -o run.csv");
  ASSERT_EQ(csv.code, 0) << csv.err;
  EXPECT_NE(test::contents(at("run.csv")).find("sensitivity,joint/flexion,medial plateau.shift.z,"),
            std::string::npos);
}

// Known poses of an earlier run are polished, and their derivatives computed anew.
TEST_F(SensitivitiesCommand, AResumedSweepHasThemOfAllPoses) {
  const std::string text = kKnee + "sensitivities = [\"*.stiffness\"]\n";
  write("knee.toml", text);
  ASSERT_EQ(run("sweep knee.toml -o run.h5 --to 30 --quiet").code, 0);
  ASSERT_EQ(run("sweep knee.toml -o run.h5 --resume --quiet").code, 0);
  const condyle::Run resumed = read_run(at("run.h5")), whole = swept(text);
  ASSERT_EQ(resumed.sensitivities->by_pose.size(), 4U);
  for (std::size_t pose = 0; pose < 4; ++pose) {
    const Eigen::MatrixXd &a = resumed.sensitivities->by_pose[pose],
                          &b = whole.sensitivities->by_pose[pose];
    EXPECT_LT((a - b).norm(), 1e-8 * b.norm());
  }
}

TEST_F(SensitivitiesCommand, ASweepWithoutThemHasNoGroup) {
  EXPECT_EQ(swept(kKnee).sensitivities, nullptr);
}

}  // namespace
}  // namespace condyle
