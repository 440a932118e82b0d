#include "app/include_graph.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

namespace condyle::test {
namespace {

namespace fs = std::filesystem;

/// What stands between quotes or, with them, between angle brackets; nothing on other lines.
std::string included(const std::string& line) {
  constexpr std::string_view kWord = "#include ";
  if (line.rfind(kWord, 0) != 0) return "";
  const std::size_t begin = kWord.size();
  const bool quoted = line[begin] == '"';
  const std::size_t end = line.find(quoted ? '"' : '>', begin + 1);
  if (end == std::string::npos) return "";
  return quoted ? line.substr(begin + 1, end - begin - 1) : line.substr(begin, end + 1 - begin);
}

/// As the include folders of the targets are: the sources, the tests, the tools. NAME.in becomes NAME
/// while the build is configured.
std::string file_named(const fs::path& root, const std::string& from, const std::string& name) {
  for (const char* top : {"src/", "tests/", "tools/"})
    for (const char* made : {"", ".in"})
      if (fs::is_regular_file(root / (top + name + made))) return top + name;
  throw std::runtime_error(from + ": includes " + name + ", which is no file");
}

using Graph = std::map<std::string, std::set<std::string>>;

/// All that can be reached from a node.
std::set<std::string> reached(const Graph& graph, const std::string& start) {
  std::set<std::string> seen;
  std::vector<std::string> open = {start};
  while (!open.empty()) {
    const std::string node = open.back();
    open.pop_back();
    const auto next = graph.find(node);
    if (next == graph.end()) continue;
    for (const std::string& other : next->second)
      if (seen.insert(other).second) open.push_back(other);
  }
  return seen;
}

}  // namespace

std::vector<Include> includes_of_project(const fs::path& root) {
  std::vector<Include> includes;
  for (const char* top : {"src", "tests", "tools"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const fs::path& path = entry.path();
      if (path.extension() != ".h" && path.extension() != ".cpp") continue;
      const std::string from = fs::relative(path, root).generic_string();
      std::ifstream stream(path);
      for (std::string line; std::getline(stream, line);) {
        const std::string name = included(line);
        if (name.empty()) continue;
        includes.push_back({from, name.front() == '<' ? name : file_named(root, from, name)});
      }
    }
  }
  return includes;
}

std::string folder(const std::string& path, int count) {
  std::size_t end = 0;
  for (int i = 0; i < count; ++i) {
    const std::size_t slash = path.find('/', end == 0 ? 0 : end + 1);
    if (slash == std::string::npos) break;
    end = slash;
  }
  return path.substr(0, end);
}

std::vector<Room> rooms_of_page(const fs::path& page) {
  std::vector<Room> rooms;
  std::ifstream stream(page);
  bool within = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("| room |", 0) == 0) within = true;
    if (within && line.empty()) break;
    if (!within || line.rfind("| `", 0) != 0) continue;
    const std::size_t name = line.find('`') + 1, end = line.find('`', name);
    const std::size_t library = line.find('`', end + 1) + 1;
    rooms.push_back(
        {line.substr(name, end - name), line.substr(library, line.find('`', library) - library)});
  }
  return rooms;
}

std::vector<std::string> circles(const std::vector<Include>& includes) {
  const auto idea = [](const std::string& file) { return file.substr(0, file.rfind('.')); };
  Graph graph;
  for (const Include& include : includes) {
    if (include.of_project() && idea(include.from) != idea(include.to))
      graph[idea(include.from)].insert(idea(include.to));
  }
  std::map<std::string, std::set<std::string>> reach;
  for (const auto& [node, next] : graph) reach[node] = reached(graph, node);
  std::set<std::string> found;
  for (const auto& [node, all] : reach) {
    if (all.count(node) == 0) continue;
    std::string circle;
    for (const std::string& other : all) {
      const auto back = reach.find(other);
      if (back == reach.end() || back->second.count(node) == 0) continue;
      circle += (circle.empty() ? "" : ", ") + other;
    }
    found.insert(circle);
  }
  return {found.begin(), found.end()};
}

}  // namespace condyle::test
