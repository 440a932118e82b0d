#include "condyle/specimen/fit_keys.h"

#include <fmt/format.h>

#include <array>

namespace condyle {
namespace {

/// Keys of the scene with what they hold, for messages.
class Keys {
 public:
  void add(const char* key, double value) { add_text(key, fmt::format("{:g}", value)); }
  template <typename Numbers>
  void add(const char* key, const Numbers& numbers, double unit) {
    std::string list;
    for (const auto& number : numbers)
      list += fmt::format("{}{:g}", list.empty() ? "" : ", ", static_cast<double>(number) / unit);
    add_text(key, "[" + list + "]");
  }
  [[nodiscard]] std::string words(const char* expected, const char* otherwise) const {
    return words_.empty() ? fmt::format("expected {}", otherwise)
                          : fmt::format("{}, expected {}", words_, expected);
  }

 private:
  void add_text(const char* key, const std::string& value) {
    words_ += fmt::format("{}{} = {}", words_.empty() ? "" : " and ", key, value);
  }
  std::string words_;
};

}  // namespace

std::string fit_keys(const PatchDescription& patch, const Scene& scene) {
  Keys keys;
  if (patch.smoothing) keys.add("fit.smoothing", *patch.smoothing / scene.length_to_mm);
  if (patch.control_points) keys.add("fit.control_points", *patch.control_points, 1);
  return keys.words("\"auto\", or a length nearer to the spacing of the vertices and fewer points",
                    "a finer mesh or a larger region");
}

std::string region_keys(const PatchDescription& patch, const Scene& scene) {
  Keys keys;
  if (patch.region_angles) keys.add("region.angles", *patch.region_angles, scene.angle_to_rad);
  if (patch.region_least_cosine) keys.add("region.least_cosine", *patch.region_least_cosine);
  if (patch.region_box) {
    const auto& [one, other] = *patch.region_box;
    keys.add("region.box", std::array{one.x(), one.y(), one.z(), other.x(), other.y(), other.z()},
             scene.length_to_mm);
  }
  return keys.words("limits that hold some of the surface",
                    "a bone with this compartment, and [joint] as the bone lies");
}

}  // namespace condyle
