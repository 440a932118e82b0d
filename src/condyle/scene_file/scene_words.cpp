#include "condyle/scene_file/scene_words.h"

#include <system_error>

#include "condyle/control_characters.h"
#include "condyle/scene_file/read_sections.h"

namespace condyle {

namespace fs = std::filesystem;

std::string scene_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += is_control(c) ? ' ' : c;
  }
  return result + '"';
}

std::string scene_comment(const std::string& text) {
  std::string result = "# ";
  for (const char c : text) result += is_control(c) ? ' ' : c;
  return result;
}

std::string mesh_path_in(const fs::path& scene, const fs::path& mesh) {
  std::error_code error;
  const fs::path folder = scene.has_parent_path() ? scene.parent_path() : fs::path(".");
  const fs::path path = fs::relative(mesh, folder, error);
  return (error || path.empty() ? fs::absolute(mesh) : path).generic_string();
}

std::string unit_name(double to_mm) {
  for (const auto& [name, factor] : length_units())
    if (factor == to_mm) return name;
  return "";
}

}  // namespace condyle
