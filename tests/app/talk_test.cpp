/// How commands talk: for people, for scripts, or not at all.

#include <nlohmann/json.hpp>

#include "app/run_program.h"
#include "condyle/results/run_file.h"
#include "condyle/version.h"

namespace condyle {
namespace {

using Json = nlohmann::json;
using test::CommandLine;
using test::contents;
using test::kScene;
using test::Outcome;

TEST_F(CommandLine, KeepsQuietWhenAsked) {
  const Outcome outcome = run("sweep knee.toml -o run.h5 --quiet");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(read_run(folder_ / "run.h5").sweep.poses.size(), 5U);
}

TEST_F(CommandLine, NamesFailuresEvenWhenQuiet) {
  test::expect_bad_input(run("sweep nobody.toml -o run.h5 --quiet"),
                         "nobody.toml: no such file, expected a scene (TOML)");
}

TEST_F(CommandLine, SumsUpASweepAsJson) {
  const Outcome outcome = run("sweep knee.toml -o run.h5 --json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["command"], "sweep");
  EXPECT_EQ(json["version"], CONDYLE_VERSION);
  EXPECT_EQ(json["exit_code"], 0);
  EXPECT_EQ(json["run"], "run.h5");
  EXPECT_EQ(json["title"], "ball and socket");
  EXPECT_EQ(json["swept"]["units"], "deg");
  EXPECT_EQ(json["counts"]["poses"], 5);
  EXPECT_EQ(json["counts"]["converged"], 5);
  ASSERT_EQ(json["poses"].size(), 5U);
  const Json& last = json["poses"][4];
  for (int i = 0; i < 5; ++i) EXPECT_EQ(json["poses"][i]["value"], 5.0 * i);  // as written
  EXPECT_EQ(last["status"], "converged");
  EXPECT_GT(last["iterations"], 0);
  EXPECT_LT(last["residual"], 1e-8);  // N
  EXPECT_EQ(json["poses"][0]["route"], "descent");
  EXPECT_EQ(json["poses"][0]["route_from"], "the start pose of the scene");
  EXPECT_EQ(last["route_from"], "the pose before it");
  EXPECT_GE(last["residuals"].size(), 2U);
  EXPECT_LE(last["residuals"].size(), last["iterations"].get<std::size_t>() + 1);
  EXPECT_LT(last["residuals"].back(), 1e-12);
  EXPECT_TRUE(json["events"].is_array());
  EXPECT_TRUE(json["warnings"].is_array());
}

// The ligament is 30 mm long at the start pose.
TEST_F(CommandLine, CarriesWhatTheStartWarnsOfFromTheSweepToTheReport) {
  write("knee.toml", with(kScene, "slack_length = 30", "slack_length = 20"));
  const std::string words =
      "its slack length of 20.00 mm means a strain of +50 % at the start pose";
  const Outcome outcome = run("sweep knee.toml -o run.h5 --json");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.err, "condyle: warning: ligament \"aACL\": " + words + "\n");
  EXPECT_EQ(Json::parse(outcome.out)["warnings"][0], "ligament \"aACL\": " + words);
  EXPECT_EQ(run("sweep knee.toml -o run.h5 --quiet").err, "");
  EXPECT_EQ(run("report run.h5 -o page.html --no-pictures --no-viewer").code, 0);
  const std::string page = contents(folder_ / "page.html");
  EXPECT_NE(page.find(words), std::string::npos);
  EXPECT_EQ(page.find("No warnings."), std::string::npos);
}

TEST_F(CommandLine, TellsAScriptWhichPosesFailed) {
  write("knee.toml", test::scene_that_falls_apart());
  const Outcome outcome = run("sweep knee.toml -o run.h5 --json");
  EXPECT_EQ(outcome.code, 2);
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["exit_code"], 2);
  EXPECT_EQ(json["counts"]["converged"], 0);
  EXPECT_NE(json["poses"][0]["status"], "converged");
  EXPECT_NE(json["poses"][0]["reason"], "");
}

TEST_F(CommandLine, TellsAScriptAboutBadInput) {
  write("knee.toml", with(kScene, "radius = 20", "radius = -20"));
  const Outcome outcome = run("sweep knee.toml -o run.h5 --json");
  EXPECT_EQ(outcome.code, 1);
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ("condyle: " + json["error"].get<std::string>() + "\n", outcome.err);
}

TEST_F(CommandLine, TellsAScriptAboutOptionsToo) {
  for (const char* line : {"sweep knee.toml --json", "sweep --json -o run.h5",
                           "sweep knee.toml -o run.h5 --json --form 0"}) {
    const Outcome outcome = run(line);
    EXPECT_EQ(outcome.code, 1) << line;
    const Json json = Json::parse(outcome.out);
    EXPECT_EQ(json["command"], "sweep");
    EXPECT_EQ("condyle: " + json["error"].get<std::string>() + "\n", outcome.err);
  }
}

TEST_F(CommandLine, RemembersTheMeshesByTheirChecksum) {
  // A tetrahedron; what sha256sum says of it is asked of sha256sum.
  write("bone.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  write("knee.toml", with(kScene, "name = \"femur\"", "name = \"femur\"\nmesh = \"bone.obj\""));
  ASSERT_EQ(run("sweep knee.toml -o run.h5 --quiet").code, 0) << contents(folder_ / "stderr.txt");
  const std::string command = "cd '" + folder_.string() + "' && sha256sum bone.obj > sum.txt";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const condyle::Run back = read_run(folder_ / "run.h5");
  ASSERT_EQ(back.inputs.size(), 1U);
  EXPECT_EQ(back.inputs[0].sha256, contents(folder_ / "sum.txt").substr(0, 64));
  EXPECT_EQ(back.program, "condyle " CONDYLE_VERSION);
  EXPECT_EQ(back.created.size(), 20U);  // 2000-01-01T00:00:00Z
}

}  // namespace
}  // namespace condyle
