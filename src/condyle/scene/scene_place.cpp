#include "condyle/scene/scene_place.h"

#include <fmt/format.h>

namespace condyle {
namespace {

template <typename Described>
std::string place_in(const Scene& scene, const char* table, const Described& described) {
  const std::string line = described.line > 0 ? fmt::format(":{}", described.line) : "";
  return fmt::format("{}{}: [[{}]] \"{}\"", scene.file.string(), line, table, described.name);
}

}  // namespace

std::string place_of(const Scene& scene, const SurfaceDescription& surface) {
  return place_in(scene, "surface", surface);
}

std::string place_of(const Scene& scene, const WrapDescription& wrap) {
  return place_in(scene, "wrap", wrap);
}

std::string place_of(const Scene& scene, const LigamentDescription& ligament) {
  return place_in(scene, "ligament", ligament);
}

}  // namespace condyle
