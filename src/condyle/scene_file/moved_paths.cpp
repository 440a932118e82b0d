#include "condyle/scene_file/moved_paths.h"

#include <system_error>

#include "condyle/scene_file/scene_words.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

}  // namespace

std::vector<TextEdit> moved_paths(const Value& document, const fs::path& from, const fs::path& to) {
  std::vector<TextEdit> edits;
  std::error_code unknown;
  if (fs::equivalent(folder_of(from), folder_of(to), unknown)) return edits;
  const auto move = [&](const Value& table, const char* key) {
    const Value* path = table.find(key);
    if (path == nullptr || path->type != Value::Type::kText || path->column <= 0) return;
    if (fs::path(path->text).is_absolute()) return;
    edits.push_back(edit_of(*path, scene_string(mesh_path_in(to, folder_of(from) / path->text))));
  };
  for (const char* list : {"body", "surface"})
    if (const Value* tables = document.find(list); tables != nullptr)
      for (const Value& table : tables->items) move(table, "mesh");
  if (const Value* calibrate = document.find("calibrate"); calibrate != nullptr)
    move(*calibrate, "measurements");
  return edits;
}

std::string moved_scene_text(const std::string& text, const fs::path& from, const fs::path& to) {
  return edited(text, moved_paths(parse_document(text, from.string()), from, to));
}

}  // namespace condyle
