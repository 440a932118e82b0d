#include "fuzz/doors.h"

#include <algorithm>
#include <stdexcept>

#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle::fuzz {
namespace {

std::string text_of(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// What a door may throw is one line.
template <typename Use>
void refused_or(Use&& use) {
  try {
    use();
  } catch (const InputError& refused) {
    const std::string line = refused.what();
    if (line.empty() || line.find('\n') != std::string::npos)
      throw std::logic_error("a refusal of other than one line: " + line);
  }
}

void open_scene(Bytes bytes) {
  refused_or([&] { (void)parse_scene(text_of(bytes), "scene.toml"); });
}

}  // namespace

const std::vector<Door>& doors() {
  static const std::vector<Door> all = {
      {.name = "scene", .open = open_scene, .largest = 16384},
  };
  return all;
}

const Door& door(const std::string& name) {
  const auto found = std::ranges::find(doors(), name, &Door::name);
  if (found == doors().end()) throw std::out_of_range("no door is called " + name);
  return *found;
}

}  // namespace condyle::fuzz
