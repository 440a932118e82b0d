#pragma once

/// Numbers and tables of a scene file that has units (scene_text.h).

#include <fmt/format.h>

#include <string>

#include "condyle/scene/scene.h"

namespace condyle::random_knees {

struct Writer {
  const Scene& scene;
  std::string text;

  [[nodiscard]] static std::string number(double x) { return fmt::format("{:.17g}", x); }
  [[nodiscard]] static std::string vector(const Eigen::Vector3d& v) {
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
  }
  [[nodiscard]] std::string length(double mm) const { return number(mm / scene.length_to_mm); }
  [[nodiscard]] std::string place(const Eigen::Vector3d& mm) const {
    return vector(mm / scene.length_to_mm);
  }
  [[nodiscard]] static std::string axes(const Eigen::Matrix3d& R) {
    return fmt::format("[{}, {}, {}]", vector(R.col(0)), vector(R.col(1)), vector(R.col(2)));
  }
  [[nodiscard]] std::string body(int index) const {
    return "\"" + scene.bodies[static_cast<std::size_t>(index)].name + "\"";
  }
  [[nodiscard]] std::string end(const Attachment& at) const {
    return fmt::format("{{ body = {}, at = {} }}", body(at.body), place(at.at));
  }
  void line(const std::string& key, const std::string& value) {
    text += key + " = " + value + "\n";
  }
  void word(const std::string& key, const std::string& value) { line(key, "\"" + value + "\""); }
  void table(const std::string& name) { text += "\n" + name + "\n"; }
};

// Tables of one entry each.
void write(Writer& out, const SurfaceDescription& surface);
void write(Writer& out, const WrapDescription& wrap);
void write(Writer& out, const LigamentDescription& ligament);

}  // namespace condyle::random_knees
