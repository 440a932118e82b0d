/// `condyle sweep --uncertainty` as a user has it: stored, read back, exported, told.

#include <cmath>

#include "app/run_program.h"
#include "condyle/results/run_file.h"
#include "condyle/study/mesh_uncertainty.h"

namespace condyle {
namespace {

using test::Outcome;

const std::string kPhantom = CONDYLE_SOURCE_DIR "/data/phantom/knee.toml";

class UncertaintyCommand : public test::CommandLine {};

TEST_F(UncertaintyCommand, IsStoredWithTheRunAndExported) {
  const Outcome outcome =
      run("sweep '" + kPhantom + "' -o run.h5 --to 60 --step 60 --uncertainty=3");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("in 3 sweeps a standard deviation of up to"), std::string::npos)
      << outcome.out;
  const condyle::Run read = read_run(at("run.h5"));
  ASSERT_NE(read.uncertainty, nullptr);
  EXPECT_EQ(read.uncertainty->sweeps, 3);
  EXPECT_EQ(read.uncertainty->converged, (std::vector<int>{3, 3}));
  ASSERT_EQ(read.uncertainty->surfaces.size(), 4u);
  EXPECT_NEAR(read.uncertainty->surfaces[0].texture.rms, 0.2, 0.05);
  for (std::size_t i = 0; i < read.uncertainty->outputs.size(); ++i)
    if (read.uncertainty->outputs[i].place == "contacts/medial/force") {
      EXPECT_GT(read.uncertainty->sd[i].at(1), 0.1);
      EXPECT_LT(read.uncertainty->sd[i].at(1), 100);
    }
  ASSERT_EQ(run("export run.h5 -o run.csv").code, 0);
  EXPECT_NE(test::contents(at("run.csv")).find("uncertainty,joint/anterior_drawer,sd,"),
            std::string::npos);
}

TEST_F(UncertaintyCommand, WithoutItASweepHasNone) {
  ASSERT_EQ(run("sweep knee.toml -o run.h5").code, 0);
  EXPECT_EQ(read_run(at("run.h5")).uncertainty, nullptr);
}

TEST_F(UncertaintyCommand, RefusesWhatHasNoMesh) {
  const Outcome exact = run("sweep knee.toml -o run.h5 --uncertainty");
  test::expect_bad_input(exact,
                         "knee.toml: no surface is fitted to a mesh, expected one with kind = "
                         "\"patch\" for --uncertainty");
  test::expect_bad_input(run("sweep '" + kPhantom + "' -o run.h5 --uncertainty=1"),
                         "--uncertainty=1: expected at least 2 sweeps");
  for (const std::string number : {"1.5", "many", "99999999999", "33333333333333333333333333"})
    test::expect_bad_input(
        run("sweep '" + kPhantom + "' -o run.h5 --uncertainty=" + number),
        "--uncertainty=" + number + ": expected a whole number of sweeps up to 1000000");
  EXPECT_TRUE(results().empty());
}

}  // namespace
}  // namespace condyle
