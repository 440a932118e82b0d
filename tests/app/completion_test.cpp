/// Shell completion, the manual page and the examples of --help, by the shells and readers of
/// manuals themselves where they are installed.

#include <sstream>

#include "app/run_program.h"

namespace condyle {
namespace {

using test::CommandLine;
using test::contents;
using test::Outcome;

bool installed(const std::string& program) {
  return std::system(("command -v " + program + " > /dev/null").c_str()) == 0;
}

/// What a shell says, run in `folder`.
std::string said(const std::filesystem::path& folder,
                 const std::string& shell,
                 const std::string& script) {
  std::ofstream(folder / "script") << script;
  const std::string command =
      "cd '" + folder.string() + "' && " + shell + " script > said.txt 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << contents(folder / "said.txt");
  return contents(folder / "said.txt");
}

TEST_F(CommandLine, CompletesInBash) {
  write("c.bash", run("completion bash").out);
  const std::string complete =
      "source ./c.bash\n"
      "t() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _condyle; echo \"${COMPREPLY[*]}\"; }\n";
  EXPECT_EQ(said(folder_, "bash", complete + "t condyle swe"), "sweep\n");
  EXPECT_EQ(said(folder_, "bash", complete + "t condyle sweep --re"), "--resume\n");
  EXPECT_EQ(said(folder_, "bash", complete + "t condyle completion ''"), "bash zsh fish\n");
  EXPECT_EQ(said(folder_, "bash", complete + "t condyle sweep -o ''"), "\n");  // files, by default
  EXPECT_EQ(said(folder_, "bash", complete + "complete -p condyle"),
            "complete -o default -F _condyle condyle\n");
}

TEST_F(CommandLine, CompletesInFish) {
  if (!installed("fish")) GTEST_SKIP() << "there is no fish";
  write("c.fish", run("completion fish").out);
  const std::string seen = said(
      folder_, "fish", "source c.fish\ncomplete -C 'condyle swe'\ncomplete -C 'condyle fit --q'");
  EXPECT_NE(seen.find("sweep\t"), std::string::npos) << seen;
  EXPECT_NE(seen.find("--quiet\t"), std::string::npos) << seen;
}

TEST_F(CommandLine, CompletesInZsh) {
  if (!installed("zsh")) GTEST_SKIP() << "there is no zsh";
  write("_condyle", run("completion zsh").out);
  EXPECT_EQ(
      said(folder_, "zsh -f",
           "autoload -U compinit\ncompinit -D -u\nsource ./_condyle\necho ${_comps[condyle]}"),
      "_condyle\n");
}

TEST_F(CommandLine, KnowsNoOtherShell) {
  const Outcome outcome = run("completion ksh");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("ksh not in {bash,zsh,fish}"), std::string::npos) << outcome.err;
}

TEST_F(CommandLine, HasAManualPage) {
  const std::string page = run("manual").out;
  EXPECT_EQ(page.rfind(".TH CONDYLE 1", 0), 0U);
  for (const char* word : {".SS condyle sweep", "\\fB\\-\\-resume\\fR", ".SH EXIT STATUS"})
    EXPECT_NE(page.find(word), std::string::npos) << word;
  if (!installed("mandoc")) GTEST_SKIP() << "there is no mandoc to read the page";
  write("condyle.1", page);
  EXPECT_EQ(std::system(("mandoc -Tlint -Werror '" + at("condyle.1") + "' > /dev/null").c_str()),
            0);
}

/// "sweep" of "  sweep   Find ..." below "Subcommands:".
std::vector<std::string> commands(const std::string& help) {
  std::vector<std::string> names;
  std::istringstream lines(help.substr(help.find("Subcommands:")));
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string name;
    if (words >> name && line.rfind("  ", 0) == 0 && line[2] != ' ') names.push_back(name);
  }
  return names;
}

/// The examples need each other's results, in the order of the commands, and the project's scenes.
TEST_F(CommandLine, GivesAnExampleOfEveryCommandThatRuns) {
  const std::filesystem::path source = CONDYLE_SOURCE_DIR;
  for (const char* folder : {"data", "meshes"})
    std::filesystem::create_directory_symlink(source / folder, folder_ / folder);
  std::filesystem::create_directory(folder_ / "out");
  const std::vector<std::string> names = commands(run("--help").out);
  ASSERT_GE(names.size(), 8U);
  const std::string path = std::filesystem::path(CONDYLE_PROGRAM).parent_path().string();
  for (const std::string& name : names) {
    const std::string help = run(name + " --help").out;
    const std::size_t example = help.find("Example: condyle " + name);
    const std::size_t sourced = help.find("Example: source <(condyle " + name);
    ASSERT_TRUE(example != std::string::npos || sourced != std::string::npos) << help;
    const std::string line = help.substr(std::min(example, sourced) + 9);
    if (name == "manual" && !installed("man")) continue;
    if (name == "import") continue;     // of a model that is not ours to ship
    if (name == "calibrate") continue;  // tests/calibration runs it
    if (name == "study") continue;      // tests/study runs it
    said(folder_, "bash -e", "PATH='" + path + "':$PATH\n" + line);
  }
}

}  // namespace
}  // namespace condyle
