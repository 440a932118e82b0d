/// The program itself, as a user runs it: exit codes, one line for a mistake, no half-written file.

#include "app/run_program.h"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <set>
#include <sstream>

#include "condyle/build_info.h"
#include "condyle/results/run_file.h"
#include "condyle/version.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

using test::CommandLine;
using test::contents;
using test::expect_bad_input;
using test::kScene;
using test::Outcome;

TEST_F(CommandLine, ChecksAScene) {
  const Outcome outcome = run("check knee.toml");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("sweep      bend from 0 to 20 deg, 5 poses"), std::string::npos)
      << outcome.out;
  EXPECT_EQ(outcome.err, "");
}

// Both bones in one file: what a sweep refuses, check refuses in the same line.
TEST_F(CommandLine, ChecksTheFitsOfASceneAsASweepMakesThem) {
  const std::filesystem::path root = CONDYLE_SOURCE_DIR;
  std::string scene = contents(root / "data/phantom/knee.toml");
  const std::string femur = (root / "meshes/femur.stl").string();
  for (const char* bone : {"femur", "tibia"})
    scene = with(scene, std::string("../../meshes/") + bone + ".stl", femur);
  write("one.toml", scene);
  const Outcome check = run("check one.toml");
  EXPECT_EQ(check.code, 1);
  EXPECT_NE(check.err.find("one.toml:17: [[body]] \"tibia\""), std::string::npos) << check.err;
  EXPECT_EQ(check.err, run("sweep one.toml -o one.h5").err);
}

TEST_F(CommandLine, SaysSoWhereNobodyTakesItsHelp) {
  for (const char* asked : {"--help", "--version", "sweep --help"}) {
    const std::string command =
        "cd '" + folder_.string() + "' && '" CONDYLE_PROGRAM "' " + asked + " >/dev/full 2>err";
    const int status = std::system(command.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << asked;
    EXPECT_EQ(contents(folder_ / "err"),
              "condyle: the standard output cannot be written, expected room for it\n");
  }
}

TEST_F(CommandLine, NamesACommandThatItDoesNotKnow) {
  const Outcome outcome = run("swep knee.toml -o run.h5");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err.rfind("condyle: unknown command \"swep\", expected one of check, fit, ", 0),
            0U)
      << outcome.err;
  EXPECT_TRUE(results().empty());
}

TEST_F(CommandLine, SaysWhichCommandOrOptionWasMeant) {
  const std::string commands = run("swep knee.toml -o run.h5").err;
  EXPECT_NE(commands.find("; did you mean \"sweep\"?"), std::string::npos) << commands;
  EXPECT_EQ(run("").err.rfind("condyle: no command, expected one of check, fit, ", 0), 0U);
  expect_bad_input(
      run("-v"),
      "unknown option -v, expected --help, --version or a command (condyle --help says more)");
  for (const char* word : {"-version", "-5", "-", "--"})
    expect_bad_input(run(word), "unknown option " + std::string(word) +
                                    (std::string(word) == "-version"
                                         ? ", did you mean --version?"
                                         : ", expected --help, --version or a command") +
                                    " (condyle --help says more)");
  const std::string help = " (condyle sweep --help says more)";
  expect_bad_input(run("sweep knee.toml -o run.h5 --form 0"),
                   "unknown option --form, did you mean --from?" + help);
  expect_bad_input(run("sweep knee.toml --out=run.h5"),
                   "unknown option --out, did you mean --output?" + help);
  expect_bad_input(run("sweep knee.toml -o run.h5 --xyz"), "unknown option --xyz" + help);
  expect_bad_input(run("sweep knee.toml -o run.h5 --step five"),
                   "--step = five, expected a number" + help);
  expect_bad_input(run("sweep knee.toml a.toml b.toml -o run.h5"),
                   "too many arguments: a.toml b.toml" + help);
  expect_bad_input(run("sweep knee.toml -o run.h5 --uncertainty 4"),
                   "too many arguments: 4, did you mean --uncertainty=4?" + help);
  expect_bad_input(run("sweep knee.toml"), "--output is required" + help);
  EXPECT_TRUE(results().empty());
}

TEST_F(CommandLine, SweepsASceneIntoAFileThatCanBeReadAgain) {
  const Outcome outcome = run("sweep knee.toml -o run.h5");
  EXPECT_EQ(outcome.code == 0 || outcome.code == 2, true) << outcome.err;
  EXPECT_NE(outcome.out.find("wrote run.h5"), std::string::npos) << outcome.out;
  const condyle::Run back = read_run(folder_ / "run.h5");
  EXPECT_EQ(back.scene.title, "ball and socket");
  EXPECT_EQ(back.sweep.poses.size(), 5U);
  EXPECT_EQ(results(), std::vector<std::string>{"run.h5"});
}

TEST_F(CommandLine, TakesItsRangeFromTheOptions) {
  const Outcome outcome = run("sweep knee.toml -o run.h5 --from 10 --to -10 --step -10");
  EXPECT_NE(outcome.out.find("wrote run.h5"), std::string::npos) << outcome.err;
  const condyle::Run back = read_run(folder_ / "run.h5");
  ASSERT_EQ(back.sweep.poses.size(), 3U);
  EXPECT_NEAR(back.sweep.poses[2].value, -10 * M_PI / 180, 1e-15);
}

TEST_F(CommandLine, TakesTheOptionsInTheUnitOfTheScene) {
  write("knee.toml", with(with(kScene, "angle = \"deg\"", "angle = \"rad\""), "to = 20\nstep = 5",
                          "to = 0.4\nstep = 0.2"));
  const Outcome outcome = run("sweep knee.toml -o run.h5 --to 0.2");
  EXPECT_NE(outcome.out.find("wrote run.h5"), std::string::npos) << outcome.err;
  const condyle::Run back = read_run(folder_ / "run.h5");
  ASSERT_EQ(back.sweep.poses.size(), 2U);
  EXPECT_NEAR(back.sweep.poses[1].value, 0.2, 1e-15);
}

TEST_F(CommandLine, ExitsWithTwoWhereAPoseDoesNotSucceed) {
  write("knee.toml", test::scene_that_falls_apart());
  const Outcome outcome = run("sweep knee.toml -o run.h5");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 5) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("condyle: bend = 0 deg: ", 0), 0U) << outcome.err;
  EXPECT_EQ(read_run(folder_ / "run.h5").sweep.count_converged(), 0);
}

TEST_F(CommandLine, SaysWhatIsWrongInAScene) {
  write("knee.toml", with(kScene, "radius = 20", "raduis = 20"));
  expect_bad_input(
      run("check knee.toml"),
      "knee.toml:26: [[surface]] \"ball\": unknown key raduis = 20, did you mean \"radius\"?");
  expect_bad_input(
      run("sweep knee.toml -o run.h5"),
      "knee.toml:26: [[surface]] \"ball\": unknown key raduis = 20, did you mean \"radius\"?");
  EXPECT_TRUE(results().empty());
}

TEST_F(CommandLine, NamesASceneThatIsNotThere) {
  write("flat.off", "OFF\n4 2 0\n0 0 0\n10 0 0\n20 0 0\n30 0 0\n3 0 1 2\n3 1 2 3\n");
  write("flat.toml", with(kScene, "name = \"tibia\"", "name = \"tibia\"\nmesh = \"flat.off\""));
  const Outcome flat = run("check flat.toml");
  EXPECT_EQ(flat.code, 1);
  EXPECT_NE(flat.err.find("flat.off: no triangle of any area is left"), std::string::npos)
      << flat.err;
  expect_bad_input(run("check nobody.toml"), "nobody.toml: no such file, expected a scene (TOML)");
}

TEST_F(CommandLine, NamesAFolderThatIsNotThereBeforeItComputes) {
  const Outcome outcome = run("sweep knee.toml -o no/run.h5");
  expect_bad_input(outcome, "no/run.h5: there is no folder no, expected one that exists");
  EXPECT_EQ(outcome.out, "");
}

TEST_F(CommandLine, LeavesNothingButItsJournalOnAFullDisk) {
  // A limit of 2 blocks on the size of files stands for a full disk.
  const Outcome outcome = run("sweep knee.toml -o run.h5", "trap '' XFSZ; ulimit -f 8; ");
  expect_bad_input(outcome,
                   "run.h5: cannot be written: File too large (its poses are in run.h5.journal: "
                   "--resume takes them over)");
  EXPECT_EQ(results(), std::vector<std::string>{"run.h5.journal"});
}

TEST_F(CommandLine, FitsOnlyWhatIsAPatch) {
  expect_bad_input(run("fit knee.toml -o fit.h5"),
                   "knee.toml: no surface has kind = \"patch\", expected one to fit");
}

TEST_F(CommandLine, SaysWhichRangeLeadsNowhere) {
  expect_bad_input(run("sweep knee.toml -o run.h5 --step -1"),
                   "--from, --to, --step: step = -1, expected a step > 0 to get from 0 to 20");
  expect_bad_input(
      run("sweep knee.toml -o run.h5 --from 1e308 --to 1e308 --step 1"),
      "--from, --to, --step: from = 1e+308, to = 1e+308, step = 1, expected numbers below 1e+100");
}

TEST_F(CommandLine, NamesTheRangeInTheNumbersOfTheScene) {
  write("knee.toml", kSmallScene);  // to 120 degrees, which is 119.99999999999999 by way of radians
  expect_bad_input(run("sweep knee.toml -o run.h5 --step 0"),
                   "--from, --to, --step: step = 0, expected a step > 0 to get from 0 to 120");
}

// What is not given is what the scene says: its own end and step, also where these are not met.
TEST_F(CommandLine, RangesStandInForWhatTheSceneSays) {
  write("knee.toml", small_scene_with("to = 120\nstep = 5", "to = 11\nstep = 4"));
  EXPECT_EQ(run("sweep knee.toml -o run.h5 --step 1").code, 0);
  EXPECT_EQ(read_run(folder_ / "run.h5").sweep.poses.size(), 12U);
  write("knee.toml", small_scene_with("to = 120\nstep = 5", "to = 3\nstep = 4"));
  EXPECT_EQ(run("sweep knee.toml -o run.h5 --to 8").code, 0);
  EXPECT_EQ(read_run(folder_ / "run.h5").sweep.poses.size(), 3U);
  write("knee.toml", small_scene_with("from = 0\nto = 120\nstep = 5", "values = [0, 20, 5]"));
  expect_bad_input(
      run("sweep knee.toml -o run.h5 --to 10"),
      "knee.toml: [sweep] lists values, expected --from, --to and --step to stand in for "
      "them");
  expect_bad_input(run("sweep knee.toml -o run.h5 --from 10 --to 1000 --step 90"),
                   "--from, --to, --step: values beyond one turn, expected angles of at most that "
                   "(suspect [units] angle)");
}

// What fish completes names every option; those with -r take a value.
TEST_F(CommandLine, TakesNoEmptyTextForAValueOfAnyOption) {
  std::istringstream lines(run("completion fish").out);
  int numbers = 0, options = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::regex with_value("seen_subcommand_from ([a-z]+)'(?: -s .)? -l ([a-z-]+) -r");
    std::smatch found;
    if (!std::regex_search(line, found, with_value)) continue;
    const std::string option = "--" + found[2].str();
    const Outcome outcome = run(found[1].str() + " " + option + " ''");
    const std::string help = " (condyle " + found[1].str() + " --help says more)";
    const bool number = outcome.err == "condyle: " + option + ": expected a number" + help + "\n";
    if (!number) expect_bad_input(outcome, option + ": expected a value" + help);
    EXPECT_EQ(outcome.code, 1);
    ++options;
    numbers += number;
  }
  EXPECT_GE(options, 40);
  EXPECT_GE(numbers, 15);
}

// What is said never decides what is kept.
TEST_F(CommandLine, KeepsItsResultWhereNobodyTakesWhatItSays) {
  const std::string sweep = "cd '" + folder_.string() +
                            "' && { '" CONDYLE_PROGRAM
                            "' sweep knee.toml -o run.h5; echo $? > code; } ";
  const std::string full = "condyle: the standard output cannot be written, expected room for it\n";
  struct Case {
    const char *streams, *code;
    std::string err;
  };
  for (const Case& c : {Case{">/dev/full 2>err", "1\n", full}, Case{">&- 2>err", "1\n", full},
                        Case{">out 2>/dev/full", "0\n", ""}, Case{"<&- >out 2>&-", "0\n", ""},
                        Case{"2>err | :", "0\n", ""}}) {
    SCOPED_TRACE(c.streams);
    write("err", "");
    ASSERT_EQ(std::system((sweep + c.streams).c_str()), 0);
    EXPECT_EQ(contents(folder_ / "code"), c.code);
    EXPECT_EQ(contents(folder_ / "err"), c.err);
    EXPECT_EQ(contents(folder_ / "run.h5").substr(1, 3), "HDF");
    EXPECT_TRUE(std::filesystem::remove(folder_ / "run.h5"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "run.h5.journal"));
  }
}

TEST_F(CommandLine, DoesNotWaitForAReaderOfItsJournal) {
  ASSERT_EQ(::mkfifo(at("run.h5.journal").c_str(), 0666), 0);
  expect_bad_input(run("sweep knee.toml -o run.h5"),
                   "run.h5.journal: cannot be written: No such device or address");
}

TEST_F(CommandLine, TakesNoEmptyTextForAValue) {
  expect_bad_input(run("sweep '' -o run.h5"),
                   "SCENE: expected a value (condyle sweep --help says more)");
  expect_bad_input(run("sweep knee.toml -o ''"),
                   "--output: expected a value (condyle sweep --help says more)");
  expect_bad_input(run("export run.h5 -o run.glb --at ''"),
                   "--at: expected a number (condyle export --help says more)");
}

TEST_F(CommandLine, TakesNoListWithAnItemThatIsNone) {
  for (const char* list : {"0,,30", ",0", "0,", ",", "0,a", "0,nan"})
    expect_bad_input(
        run(std::string("export run.h5 -o run.glb --at ") + list),
        std::string("--at = ") + list +
            ", expected numbers with a comma between two (condyle export --help says more)");
  expect_bad_input(run("export run.h5 -o out --format csv,,stl"),
                   "--format = csv,,stl, expected words with a comma between two (condyle export "
                   "--help says more)");
}

TEST_F(CommandLine, TakesNoNumberForAnotherOne) {
  const auto refuses = [&](const std::string& command, const std::string& option,
                           const std::string& value, const std::string& expected) {
    expect_bad_input(run(command + " " + option + " " + value),
                     option + ": " + value + ", expected " + expected + " (condyle " +
                         command.substr(0, command.find(' ')) + " --help says more)");
  };
  refuses("compare knee.toml -o run.h5", "--strain", "nan", "a finite number");
  refuses("laxity knee.toml -o run.h5", "--strain", "-inf", "a finite number");
  refuses("sweep knee.toml -o run.h5", "--to", "1e999", "a finite number");
  refuses("compare knee.toml -o run.h5", "--degree", "2.5", "a whole number");
  refuses("study knee.toml -o run.h5", "--samples", "1e3", "a whole number");
  refuses("export run.h5 -o run.glb", "--triangles", "-5", "a whole number >= 0");
  EXPECT_TRUE(results().empty());
}

// A radius of 20 m: the plateau is flat to 0.02 mm where the ball touches it. A minute and gigabytes once.
TEST_F(CommandLine, SweepsOnASurfaceFarLargerThanAKneeAndDoubtsItsUnit) {
  const std::string plateau = "kind = \"sphere\"\ncenter = [0, -20000, 0]\nradius = 20000\n";
  write("large.toml",
        with(kScene, "kind = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 1, 0]\n", plateau));
  const std::string doubt =
      "warning: surface \"plateau\": 40000 mm across, expected 0.5 to 2000 mm (suspect the "
      "units)\n";
  EXPECT_NE(run("check large.toml").out.find(doubt), std::string::npos);
#ifdef __SANITIZE_ADDRESS__  // needs all of the address space
  const Outcome outcome = run("sweep large.toml -o run.h5");
#else
  const Outcome outcome = run("sweep large.toml -o run.h5", "ulimit -v 2000000; ulimit -t 20; ");
#endif
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE((outcome.out + outcome.err).find(doubt), std::string::npos) << outcome.out;
  EXPECT_EQ(run("verify run.h5").code, 0);
}

TEST_F(CommandLine, NamesWhatIsNoFile) {
  expect_bad_input(run("verify /dev/zero"), "/dev/zero: is no plain file, expected a run (HDF5)");
  write("mesh.toml", with(kScene, "fixed = true", "fixed = true\nmesh = \"..\""));
  const Outcome outcome = run("check mesh.toml");
  EXPECT_EQ(outcome.err.rfind("condyle: mesh.toml:10: [[body]] \"femur\": mesh = \"..\", expected "
                              "a mesh file (no file is ..",
                              0),
            0U)
      << outcome.err;
}

#ifdef CONDYLE_PICTURES
TEST_F(CommandLine, WritesNoPngUnderTheNameOfAnotherFormat) {
  for (const char* file : {"page.jpg", "page.pdf", "page.html"})
    expect_bad_input(run(std::string("check knee.toml --report ") + file),
                     std::string(file) + ": the picture is PNG, expected a name that ends in .png");
  EXPECT_TRUE(results().empty());
}
#endif

TEST_F(CommandLine, WritesNoResultUnderTheNameOfAnotherFormat) {
  for (const char* file : {"other.toml", "femur.stl", "FEMUR.STL", "page.html"})
    expect_bad_input(run(std::string("sweep knee.toml -o ") + file),
                     std::string(file) + ": expected a name that ends in .h5");
}

TEST_F(CommandLine, NeedsASweep) {
  write("knee.toml", kScene.substr(0, kScene.find("[sweep]")));
  expect_bad_input(run("sweep knee.toml -o run.h5"),
                   "knee.toml: [sweep] is missing, expected what to vary and how far");
}

TEST_F(CommandLine, NamesAnOptionThatItDoesNotKnow) {
  const Outcome outcome = run("sweep knee.toml --out run.h5");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("--help"), std::string::npos);
}

TEST_F(CommandLine, ExplainsItself) {
  const Outcome outcome = run("--help");
  EXPECT_EQ(outcome.code, 0);
  for (const char* command : {"check", "fit", "sweep"}) {
    EXPECT_NE(outcome.out.find(command), std::string::npos) << command;
  }
  EXPECT_EQ(run("").code, 1);
}

TEST_F(CommandLine, SaysItsVersionAndHowItWasBuilt) {
  const BuildInfo info = build_info();
  EXPECT_EQ(run("--version").out,
            "condyle " CONDYLE_VERSION "\nbuild: " + info.made_by + ", " + info.build_type + ", " +
                info.compiler + ", " + info.processor + "\n" +
                build_lines(info).substr(build_lines(info).find('\n') + 1) + "\n");
  for (const std::string& fact : {info.made_by, info.build_type, info.compiler, info.processor})
    EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(fact.at(0)))) << fact;
  std::set<std::string> names;
  for (const BuiltWith& library : info.libraries) {
    names.insert(library.name);
    EXPECT_TRUE(std::isdigit(static_cast<unsigned char>(library.version.at(0)))) << library.name;
  }
  EXPECT_EQ(names.size(), info.libraries.size());
  for (const char* name : {"Eigen", "HDF5", "SUNDIALS", "Ceres"}) EXPECT_EQ(names.count(name), 1U);
}

}  // namespace
}  // namespace condyle
