/// `condyle verify` as a user runs it.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/run_program.h"
#include "condyle/results/run_file.h"

namespace condyle {
namespace {

using test::CommandLine;
using test::Outcome;

class VerifyCommand : public CommandLine {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    static std::string bytes;  // of a run that is computed once
    if (bytes.empty()) {
      ASSERT_NE(run("sweep knee.toml -o run.h5").code, 1);
      bytes = test::contents(folder_ / "run.h5");
    }
    write("run.h5", bytes);
  }
  /// The run with its second pose moved by a tenth of a millimetre.
  void damage() const {
    condyle::Run read = read_run(folder_ / "run.h5");
    read.sweep.poses.at(1).X_BA.p.y() += 0.1;
    write_run(folder_ / "run.h5", read);
  }
};

TEST_F(VerifyCommand, SaysThatAllIsWell) {
  const Outcome outcome = run("verify run.h5");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("5 of 5 poses converged, none of them is false\n"), std::string::npos)
      << outcome.out;
  EXPECT_NE(outcome.out.find("overlap of the surfaces"), std::string::npos);
}

TEST_F(VerifyCommand, NamesTheFalsePose) {
  damage();
  const Outcome outcome = run("verify run.h5");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.out.find("1 of them is false"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.err.find("condyle: bend = 5 deg: contact \"medial\": surfaces \"ball\" and "
                             "\"plateau\" overlap by 0.0"),
            std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find(" mm of femur"), std::string::npos) << outcome.err;
}

TEST_F(VerifyCommand, TellsScripts) {
  damage();
  const Outcome outcome = run("verify run.h5 --json");
  EXPECT_EQ(outcome.code, 2);
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["exit_code"], 2);
  EXPECT_EQ(json["verified"], false);
  EXPECT_EQ(json["counts"]["false"], 1);
  EXPECT_NEAR(json["false_poses"][0]["value"].get<double>(), 5, 1e-9);
}

TEST_F(VerifyCommand, RefusesAFileThatIsNoRun) {
  EXPECT_EQ(run("verify knee.toml").code, 1);
  EXPECT_EQ(run("verify nobody.h5").code, 1);
}

TEST_F(VerifyCommand, StandsInTheReport) {
  damage();
  ASSERT_EQ(run("report run.h5 -o page.html --no-pictures --no-viewer").code, 0);
  const std::string page = test::contents(folder_ / "page.html");
  EXPECT_NE(page.find("Verified: 5 of 5 poses converged, 1 of them is false"), std::string::npos);
}

}  // namespace
}  // namespace condyle
