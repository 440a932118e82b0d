/// Every command line that the documentation shows, run as it stands there; and every shipped scene
/// with the commands that it is for.

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>
#include <sstream>

#include "app/run_program.h"
#include "exchange/jcs_files.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using test::CommandLine;
using test::contents;
using test::Outcome;

const fs::path kRoot = CONDYLE_SOURCE_DIR;

/// README and the pages of docs.
std::vector<fs::path> pages() {
  std::vector<fs::path> pages = {kRoot / "README.md"};
  for (const auto& entry : fs::directory_iterator(kRoot / "docs"))
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  std::sort(pages.begin(), pages.end());
  return pages;
}

struct Command {
  std::string line;
  int code;  ///< 2 where a comment behind it says "exit code 2", else 0
};

/// Indented lines "condyle ..." without comments and pipes, but for synopses (SCENE, DIR ...).
std::vector<Command> commands_of(const fs::path& page) {
  static const std::regex command(R"(^    (?:build/)?condyle ([a-z].*?)(?:   .*| \|.*|  #.*)?$)");
  static const std::regex synopsis(R"(\b[A-Z]{3,}|^journal |\w\|\w)");
  static const std::regex failing(R"(  # .*\bexit code 2\b)");
  std::vector<Command> found;
  std::istringstream lines(contents(page));
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, command)) continue;
    if (std::regex_search(line, synopsis) || std::regex_search(match[1].str(), synopsis)) continue;
    found.push_back({match[1], std::regex_search(line, failing) ? 2 : 0});
  }
  return found;
}

/// Those that show commands.
std::vector<fs::path> pages_with_commands() {
  std::vector<fs::path> shown;
  for (const fs::path& page : pages())
    if (!commands_of(page).empty()) shown.push_back(page);
  return shown;
}

/// In a folder that has what a reader would have: the shipped data, a scene, a model, earlier runs.
class DocsCommands : public CommandLine, public testing::WithParamInterface<fs::path> {
 protected:
  void SetUp() override {
    CommandLine::SetUp();
    for (const char* name : {"data", "meshes"})
      fs::create_directory_symlink(kRoot / name, folder_ / name);
    fs::create_directories(folder_ / "out/softer");
    write("out/softer/knee.toml",
          with(contents(kRoot / "data/phantom/knee.toml"), "stiffness = 1500", "stiffness = 1200"));
    write("knee.toml", contents(kRoot / "data/wismans-type/knee.toml"));
    write("study.toml",
          "specimens = \"knee.toml\"\ndesign = \"monte-carlo\"\nsamples = 100\n[[vary]]\nwhat = "
          "\"reference_strain\"\nof = \"*\"\nsd = 0.02\n");
    std::string model = contents(kRoot / "tests/data/phantom_jam.osim");
    for (std::size_t at; (at = model.find("../../meshes")) != std::string::npos;)
      model.replace(at, 12, (kRoot / "meshes").string());
    write("knee.osim", model);
    write("EI1_kinematics_in_JCS_experiment.csv", test::kKinematics);
    write("EI1_TibiaKinetics_in_TibiaCS_experiment.csv", test::kKinetics);
    write("State.cfg", test::kState);
    EXPECT_EQ(run("sweep knee.toml -o run.h5").code, 0);
    EXPECT_EQ(run("sweep data/phantom/knee.toml -o out/phantom.h5").code, 0);
    for (const char* name : {"intact.h5", "cut.h5"})
      fs::copy_file(folder_ / "run.h5", folder_ / name);
  }
};

TEST_P(DocsCommands, RunAsTheyStandThere) {
  for (const Command& command : commands_of(GetParam())) {
    const Outcome outcome = run(command.line);
    EXPECT_EQ(outcome.code, command.code) << "condyle " << command.line << "\n" << outcome.err;
  }
}

INSTANTIATE_TEST_SUITE_P(Pages,
                         DocsCommands,
                         testing::ValuesIn(pages_with_commands()),
                         [](const testing::TestParamInfo<fs::path>& page) {
                           std::string name = page.param.stem().string();
                           std::replace_if(
                               name.begin(), name.end(),
                               [](unsigned char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

TEST(DocsPages, ShowCommands) {
  std::size_t count = 0;
  for (const fs::path& page : pages()) count += commands_of(page).size();
  EXPECT_GT(count, 20U);
}

// Links within the project and files in backquotes are those that there are; a name without ending is not looked at.
TEST(DocsPages, NameOnlyFilesThatAreThere) {
  static const std::regex link(R"(\]\(([^)#:\s]+)(?:#[^)]*)?\))");
  static const std::regex file(R"(`((?:src|tests|tools|data|docs|meshes)/[\w./-]+\.\w+)`)");
  int count = 0;
  for (const fs::path& page : pages()) {
    const std::string text = contents(page);
    for (const auto& [pattern, from] : {std::pair{&link, page.parent_path()}, {&file, kRoot}})
      for (std::sregex_iterator it(text.begin(), text.end(), *pattern), end; it != end; ++it) {
        EXPECT_TRUE(fs::exists(from / (*it)[1].str())) << page << ": " << (*it)[1];
        ++count;
      }
  }
  EXPECT_GT(count, 100);
}

/// The anchors of a page: its headings in lower case, with hyphens for blanks and without punctuation; the second of a name
/// gets "-1".
std::set<std::string> anchors_of(const fs::path& page) {
  std::set<std::string> anchors;
  std::istringstream lines(contents(page));
  bool code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("```", 0) == 0) code = !code;
    const std::size_t text = line.find_first_not_of('#');
    if (code || text == 0 || text == std::string::npos || line[text] != ' ') continue;
    std::string anchor;
    for (const char c : line.substr(text + 1)) {
      const auto byte = static_cast<unsigned char>(c);
      if (byte >= 0x80 || std::isalnum(byte) || c == '-' || c == '_')
        anchor += static_cast<char>(std::tolower(byte));
      else if (c == ' ')
        anchor += '-';
    }
    std::string name = anchor;
    for (int again = 1; !anchors.insert(name).second; ++again)
      name = anchor + "-" + std::to_string(again);
  }
  return anchors;
}

TEST(DocsPages, NameOnlyPlacesThatAreThere) {
  static const std::regex link(R"(\]\(([^)#:\s]*)#([^)\s]+)\))");
  int count = 0;
  for (const fs::path& page : pages()) {
    const std::string text = contents(page);
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
      const std::string file = (*it)[1].str(), anchor = (*it)[2].str();
      EXPECT_EQ(anchors_of(file.empty() ? page : page.parent_path() / file).count(anchor), 1U)
          << page << ": " << file << "#" << anchor;
      ++count;
    }
  }
  EXPECT_GT(count, 10);
}

TEST(DocsPages, AreAllInTheNavigationOfTheSite) {
  const std::string site = contents(kRoot / "tools/docs/mkdocs.yml");
  for (const fs::path& page : pages()) {
    if (page.filename() == "README.md") continue;
    EXPECT_NE(site.find(": " + page.filename().string() + "\n"), std::string::npos) << page;
  }
}

class ShippedScene : public CommandLine, public testing::WithParamInterface<const char*> {};

// All poses of ours converge: exit code 0.
TEST_P(ShippedScene, RunsToItsEnd) {
  const std::string command = GetParam();
  const std::size_t blank = command.rfind(' ');
  const Outcome outcome = run(command.substr(0, blank) + " '" + kRoot.string() + "/data/" +
                              command.substr(blank + 1) + "' -o run.h5");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

INSTANTIATE_TEST_SUITE_P(Data,
                         ShippedScene,
                         testing::Values("sweep dortmans/problem1.toml",
                                         "sweep dortmans/problem2.toml",
                                         "sweep dortmans/problem3.toml",
                                         "sweep dortmans/cancellation.toml",
                                         "sweep phantom/knee.toml",
                                         "sweep phantom/layered.toml",
                                         "sweep phantom/wrapped.toml",
                                         "laxity phantom/drawer.toml",
                                         "sweep phantom/calibrate.toml",
                                         "simulate phantom/pendulum.toml",
                                         "simulate phantom/blow.toml",
                                         "simulate phantom/decaying-sine.toml",
                                         "study --samples 4 studies/roughness.toml",
                                         "sweep wismans-type/knee.toml",
                                         "compare wismans-type/knee.toml",
                                         "laxity wismans-type/drawer.toml"));

/// Here, or where a page runs them; the scenes of data/hard by tests/hard, each to the end that it is meant to have.
TEST(ShippedScenes, AreAllRun) {
  std::vector<std::string> scenes;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "data"))
    if (entry.path().extension() == ".toml")
      scenes.push_back(fs::relative(entry.path(), kRoot / "data").generic_string());
  std::string here = contents(kRoot / "tests/app/docs_commands_test.cpp");
  for (const fs::path& page : pages())
    for (const Command& command : commands_of(page))
      if (command.code == 0)
        here += std::regex_replace(command.line, std::regex(" data/(\\S+)"), " $1\"");
  const std::string hard = contents(kRoot / "tests/support/hard_cases.cpp");
  for (const std::string& scene : scenes) {
    const bool is_hard = scene.rfind("hard/", 0) == 0;
    const std::string& source = is_hard ? hard : here;
    EXPECT_NE(source.find(is_hard ? "\"" + scene.substr(5) + "\"" : " " + scene + "\""),
              std::string::npos)
        << scene;
  }
}

}  // namespace
}  // namespace condyle
