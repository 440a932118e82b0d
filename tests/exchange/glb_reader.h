#pragma once

/// A reader of .glb files that shares nothing with the writer: chunks by hand, JSON by nlohmann.

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace condyle::test {

class GlbReader {
 public:
  explicit GlbReader(const std::string& bytes) : bytes_(bytes) {
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(number(4), 2U);
    EXPECT_EQ(number(8), bytes.size());
    const std::size_t length = number(12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    json = nlohmann::json::parse(bytes.substr(20, length));
    EXPECT_EQ(bytes.substr(24 + length, 3), "BIN");
    binary_ = 28 + length;
  }

  /// Index of the node of that name; -1 where there is none.
  [[nodiscard]] int node(const std::string& name) const {
    for (std::size_t i = 0; i < json["nodes"].size(); ++i)
      if (json["nodes"][i]["name"] == name) return static_cast<int>(i);
    return -1;
  }

  /// The numbers of an accessor, converted from float.
  [[nodiscard]] std::vector<double> floats(int accessor) const {
    const auto& a = json["accessors"][accessor];
    EXPECT_EQ(a["componentType"], 5126);
    const std::size_t width = a["type"] == "SCALAR" ? 1 : a["type"] == "VEC3" ? 3 : 4;
    std::vector<float> values(width * a["count"].get<std::size_t>());
    std::memcpy(values.data(), bytes_.data() + start(a), values.size() * sizeof(float));
    return {values.begin(), values.end()};
  }

  [[nodiscard]] std::vector<std::uint32_t> corners(int accessor) const {
    const auto& a = json["accessors"][accessor];
    EXPECT_EQ(a["componentType"], 5125);
    std::vector<std::uint32_t> values(a["count"].get<std::size_t>());
    std::memcpy(values.data(), bytes_.data() + start(a), values.size() * sizeof(std::uint32_t));
    return values;
  }

  [[nodiscard]] const nlohmann::json& primitive(int node) const {
    return json["meshes"][json["nodes"][node]["mesh"].get<int>()]["primitives"][0];
  }

  [[nodiscard]] std::vector<Eigen::Vector3d> positions(int node) const {
    const std::vector<double> v = floats(primitive(node)["attributes"]["POSITION"]);
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < v.size(); i += 3) points.emplace_back(v[i], v[i + 1], v[i + 2]);
    return points;
  }

  /// Keyframes of a node's "translation", "rotation" or "scale".
  [[nodiscard]] std::vector<double> keys(int node, const std::string& path) const {
    for (const auto& channel : json["animations"][0]["channels"]) {
      if (channel["target"]["node"] == node && channel["target"]["path"] == path)
        return floats(json["animations"][0]["samplers"][channel["sampler"].get<int>()]["output"]);
    }
    return {};
  }
  [[nodiscard]] std::vector<double> times_of(int node, const std::string& path) const {
    for (const auto& channel : json["animations"][0]["channels"])
      if (channel["target"]["node"] == node && channel["target"]["path"] == path)
        return floats(json["animations"][0]["samplers"][channel["sampler"].get<int>()]["input"]);
    return {};
  }
  [[nodiscard]] std::vector<double> times() const {
    return floats(json["animations"][0]["samplers"][0]["input"]);
  }

  /// Where the node stands in its parent at a keyframe.
  [[nodiscard]] Eigen::Affine3d place(int node, std::size_t key) const {
    const std::vector<double> t = keys(node, "translation"), r = keys(node, "rotation"),
                              s = keys(node, "scale");
    Eigen::Affine3d X = Eigen::Affine3d::Identity();
    X.translate(Eigen::Vector3d(t[3 * key], t[3 * key + 1], t[3 * key + 2]));
    X.rotate(Eigen::Quaterniond(r[4 * key + 3], r[4 * key], r[4 * key + 1], r[4 * key + 2]));
    if (!s.empty()) X.scale(Eigen::Vector3d(s[3 * key], s[3 * key + 1], s[3 * key + 2]));
    return X;
  }

  nlohmann::json json;

 private:
  [[nodiscard]] std::uint32_t number(std::size_t at) const {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes_.data() + at, sizeof value);
    return value;
  }
  [[nodiscard]] std::size_t start(const nlohmann::json& accessor) const {
    return binary_ + json["bufferViews"][accessor["bufferView"].get<int>()].value("byteOffset", 0U);
  }

  std::string bytes_;
  std::size_t binary_ = 0;
};

}  // namespace condyle::test
