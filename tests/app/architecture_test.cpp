/// What docs/architecture.md says of includes, read in every source: the page stays true because
/// its own table is what is asked.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "app/include_graph.h"
#include "app/run_program.h"

namespace condyle::test {
namespace {

const std::filesystem::path kProject = CONDYLE_SOURCE_DIR;
const std::string kSources = "src/condyle";

const std::vector<Include>& includes() {
  static const std::vector<Include> all = includes_of_project(kProject);
  return all;
}

const std::vector<Room>& rooms() {
  static const std::vector<Room> all = rooms_of_page(kProject / "docs/architecture.md");
  return all;
}

/// Place of a source's room in the table; -1 for what stands beside the rooms and serves every room.
int row_of(const std::string& file) {
  const std::string room = folder(file, 3);
  if (room == kSources) return -1;
  const auto at = std::find_if(rooms().begin(), rooms().end(), [&](const Room& row) {
    return row.name == room.substr(kSources.size() + 1);
  });
  return static_cast<int>(at - rooms().begin());
}

/// The library of a file of src; none for what stands beside the rooms and serves every one.
std::string library_of(const std::string& file) {
  const int row = row_of(file);
  return row < 0 ? "" : rooms().at(static_cast<std::size_t>(row)).library;
}

bool starts_with(const std::string& text, const std::string& begin) {
  return text.rfind(begin, 0) == 0;
}

TEST(Architecture, EveryRoomHasARowOfTheTableAndEveryRowARoom) {
  std::set<std::string> folders;
  for (const auto& entry : std::filesystem::directory_iterator(kProject / kSources))
    if (entry.is_directory()) folders.insert(entry.path().filename().string());
  std::set<std::string> rows;
  for (const Room& room : rooms()) rows.insert(room.name);
  EXPECT_EQ(folders, rows);
  EXPECT_GT(includes().size(), 2000U);
}

TEST(Architecture, IncludesGoOnlyUpwardsInTheTable) {
  for (const Include& include : includes()) {
    if (!starts_with(include.from, "src/") || !include.of_project()) continue;
    EXPECT_TRUE(starts_with(include.to, "src/")) << include.from << " includes " << include.to;
    EXPECT_LE(row_of(include.to), row_of(include.from))
        << include.from << " includes " << include.to;
  }
}

/// Who links the mechanics alone needs Eigen, and the headers of nothing else: nanoflann and fmt are
/// inside.
TEST(Architecture, TheMechanicsIncludesNoOtherLibraryAndItsHeadersNothingButEigen) {
  int files = 0;
  for (const Include& include : includes()) {
    if (!starts_with(include.from, "src/") || library_of(include.from) != "mechanics") continue;
    ++files;
    if (include.of_project()) {
      const std::string library = library_of(include.to);
      EXPECT_TRUE(library.empty() || library == "mechanics")
          << include.from << " includes " << include.to;
      continue;
    }
    const bool standard = include.to.find_first_of("/.") == std::string::npos;
    if (standard || starts_with(include.to, "<Eigen/")) continue;
    const bool inside = include.from == "src/condyle/mesh/point_tree.h" ||
                        include.from.substr(include.from.rfind('.')) == ".cpp";
    EXPECT_TRUE(inside &&
                (starts_with(include.to, "<nanoflann") || starts_with(include.to, "<fmt/")))
        << include.from << " includes " << include.to;
  }
  EXPECT_GT(files, 300);
}

/// Each library on top of the one before it: a room stands among those of its own.
TEST(Architecture, RoomsOfALibraryStandTogetherInTheTable) {
  std::vector<std::string> libraries;
  for (const Room& room : rooms())
    if (libraries.empty() || libraries.back() != room.library) libraries.push_back(room.library);
  EXPECT_EQ(libraries, (std::vector<std::string>{"mechanics", "io", "pictures", "program"}));
}

/// What tests and tools share stands in tests/support; tests may use tools, tools no tests.
TEST(Architecture, ToolsIncludeNoTestsAndWhatBothShareIncludesNeither) {
  for (const Include& include : includes()) {
    if (!include.of_project()) continue;
    const bool shared = folder(include.to, 2) == "tests/support";
    if (folder(include.from, 2) == "tests/support") {
      EXPECT_TRUE(shared || starts_with(include.to, "src/"))
          << include.from << " includes " << include.to;
    } else if (starts_with(include.from, "tools/")) {
      EXPECT_TRUE(shared || !starts_with(include.to, "tests/"))
          << include.from << " includes " << include.to;
    }
  }
}

/// Files that include each other, over however many others.
TEST(Architecture, NoFilesGoInACircle) {
  EXPECT_EQ(circles(includes()), std::vector<std::string>());
}

TEST(Architecture, ACircleOverThreeFilesIsSeenAndAHeaderWithItsSourceIsNone) {
  const std::vector<Include> made = {{"src/a/x.cpp", "src/a/x.h"}, {"src/a/x.cpp", "src/a/y.h"},
                                     {"src/a/y.h", "src/a/z.h"},   {"src/a/z.cpp", "src/a/x.h"},
                                     {"src/a/w.h", "src/a/x.h"},   {"src/a/x.h", "<vector>"}};
  EXPECT_EQ(circles(made), std::vector<std::string>{"src/a/x, src/a/y, src/a/z"});
}

TEST(Architecture, EachLibraryIsIncludedInOneRoom) {
  const std::map<std::string, std::string> room_of = {
      {"<assimp/", "mesh_files"},   {"<nanoflann", "mesh"},
      {"<toml++/", "scene_file"},   {"<cvode/", "network"},
      {"<hdf5", "results"},         {"<openssl/", "results"},
      {"<tiny_gltf", "exchange"},   {"<meshoptimizer", "exchange"},
      {"<pugixml", "exchange"},     {"<GL/", "pictures"},
      {"<png.h", "pictures"},       {"<ft2build", "pictures"},
      {"<nlohmann/json", "report"}, {"<CLI/", "app"},
      {"<mpi.h", "cluster"},        {"<pybind11/", "python"}};
  std::set<std::string> seen;
  for (const Include& include : includes()) {
    if (!starts_with(include.from, "src/")) continue;
    for (const auto& [library, room] : room_of) {
      if (!starts_with(include.to, library)) continue;
      seen.insert(library);
      EXPECT_EQ(folder(include.from, 3), "src/condyle/" + room)
          << include.from << " has " << include.to;
    }
  }
  EXPECT_EQ(seen.size(), room_of.size());
}

// Without its header a cross product is declared and links nowhere, which precompiled headers hide.
TEST(Architecture, WhoTakesCrossProductsIncludesTheGeometryOfEigen) {
  std::set<std::string> geometry;
  for (const Include& include : includes())
    if (starts_with(include.to, "<Eigen/Geometry")) geometry.insert(include.from);
  int takers = 0;
  for (const char* root : {"src", "tools"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kProject / root)) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".cpp" && ending != ".h") continue;
      const std::string text = contents(entry.path());
      if (text.find(".cross(") == std::string::npos &&
          text.find("unitOrthogonal(") == std::string::npos)
        continue;
      ++takers;
      EXPECT_TRUE(geometry.contains(entry.path().lexically_relative(kProject).generic_string()))
          << entry.path();
    }
  EXPECT_GT(takers, 80);
}

/// A second way to the answer is one only as long as it borrows no solver; a check likewise.
TEST(Architecture, TheReferenceModelAndTheVerifierShareNoLineOfASolver) {
  const std::set<std::string> of_the_verifier = {"src/condyle/surface/patch.h",
                                                 "src/condyle/math/rigid_transform.h"};
  int files = 0;
  for (const Include& include : includes()) {
    const std::string room = folder(include.from, 3), other = folder(include.to, 3);
    if (room == "src/condyle/reference" && other == "src/condyle/equilibrium") {
      ++files;
      EXPECT_EQ(include.to, "src/condyle/equilibrium/pose_result.h") << include.from;
    }
    if (room != "src/condyle/verify" || !include.of_project()) continue;
    const bool free = other == kSources || other == "src/condyle/verify" ||
                      other == "src/condyle/scene" || other == "src/condyle/results" ||
                      other == "src/condyle/mesh" || other == "src/condyle/mesh_files";
    EXPECT_TRUE(free || of_the_verifier.count(include.to) == 1)
        << include.from << " includes " << include.to;
  }
  EXPECT_GT(files, 0);
}

/// The equations of a network know nothing of the other solver.
TEST(Architecture, OnlyWhatMakesStartsAndTellsAMotionOfTheNetworkKnowsTheEquilibrium) {
  const std::set<std::string> doors = {
      "src/condyle/network/contact_detection", "src/condyle/network/knee_network",
      "src/condyle/network/motion_poses", "src/condyle/network/simulate"};
  for (const Include& include : includes()) {
    if (folder(include.from, 3) != "src/condyle/network" ||
        folder(include.to, 3) != "src/condyle/equilibrium")
      continue;
    EXPECT_TRUE(doors.count(include.from.substr(0, include.from.rfind('.'))) == 1 ||
                include.to == "src/condyle/equilibrium/pose_result.h")
        << include.from << " includes " << include.to;
  }
}

/// An edit of the network rebuilds nobody who shows a run.
TEST(Architecture, WhoShowsARunIncludesNothingOfTheNetworkOverHoweverManyFiles) {
  std::map<std::string, std::vector<std::string>> next;
  for (const Include& include : includes())
    if (include.of_project()) next[include.from].push_back(include.to);
  for (const auto& entry : next) {
    const std::string room = folder(entry.first, 3);
    if (room != "src/condyle/pictures" && room != "src/condyle/exchange" &&
        room != "src/condyle/report")
      continue;
    std::set<std::string> seen;
    std::vector<std::string> open = {entry.first};
    while (!open.empty()) {
      const std::string file = open.back();
      open.pop_back();
      EXPECT_NE(folder(file, 3), "src/condyle/network") << file << " reached from " << entry.first;
      for (const std::string& other : next[file])
        if (seen.insert(other).second) open.push_back(other);
    }
  }
}

/// Two types of one name in one namespace are one type to the linker, which keeps one of the functions that are made of them
/// (of std::vector, say) for both.
TEST(Architecture, NoTwoHeadersOfOneNamespaceDefineATypeOfOneName) {
  const std::regex space("^namespace ([a-z0-9_:]+) \\{"),
      type("^(?:struct|class|enum class) ([A-Z][A-Za-z0-9]*)[^;]*\\{");
  std::map<std::string, std::string> defined_in;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(kProject / kSources)) {
    if (entry.path().extension() != ".h") continue;
    const std::string file = entry.path().lexically_relative(kProject).string();
    std::istringstream lines(contents(entry.path()));
    std::string inside;
    std::smatch found;
    for (std::string line; std::getline(lines, line);) {
      if (std::regex_search(line, found, space)) inside = found[1];
      if (!std::regex_search(line, found, type)) continue;
      const auto [other, is_new] = defined_in.emplace(inside + "::" + found[1].str(), file);
      EXPECT_TRUE(is_new) << other->first << " of " << file << " and of " << other->second;
    }
  }
  EXPECT_GT(defined_in.size(), 300U);
}

}  // namespace
}  // namespace condyle::test
