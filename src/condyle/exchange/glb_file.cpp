#include "condyle/exchange/glb_file.h"

#include <tiny_gltf.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <functional>
#include <sstream>

namespace condyle {
namespace {

using Eigen::Vector3f;

class GlbWriter {
 public:
  explicit GlbWriter(const GlbDocument& document) : document_(document) {
    model_.asset.version = "2.0";
    model_.asset.generator = "condyle";
    model_.buffers.emplace_back();
  }

  [[nodiscard]] std::string bytes() {
    for (const GlbMaterial& material : document_.materials) add_material(material);
    for (const GlbMesh& mesh : document_.meshes) add_mesh(mesh);
    for (const GlbNode& node : document_.nodes) add_node(node);
    add_animation();
    tinygltf::Scene scene;
    scene.name = document_.title;
    scene.nodes = {0};
    scene.extras = extras(document_.extras, document_.words);
    model_.scenes.push_back(scene);
    model_.defaultScene = 0;
    std::ostringstream stream;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, stream, false, true);
    return stream.str();
  }

 private:
  /// Appends numbers to the buffer as an accessor; returns its index.
  template <typename T>
  int add_numbers(const std::vector<T>& values, int component, int type, int target = 0) {
    std::vector<unsigned char>& buffer = model_.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = buffer.size();
    view.byteLength = values.size() * sizeof(T);
    view.target = target;
    buffer.resize(view.byteOffset + view.byteLength);
    std::memcpy(buffer.data() + view.byteOffset, values.data(), view.byteLength);
    model_.bufferViews.push_back(view);

    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
    accessor.componentType = component;
    accessor.type = type;
    accessor.count = values.size() / static_cast<std::size_t>(tinygltf::GetNumComponentsInType(
                                         static_cast<std::uint32_t>(type)));
    model_.accessors.push_back(accessor);
    return static_cast<int>(model_.accessors.size()) - 1;
  }

  int add_vectors(const std::vector<Vector3f>& vectors, int target) {
    std::vector<float> values;
    values.reserve(3 * vectors.size());
    for (const Vector3f& v : vectors) values.insert(values.end(), v.data(), v.data() + 3);
    return add_numbers(values, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, target);
  }

  /// The format wants the bounds of positions.
  int add_positions(const std::vector<Vector3f>& positions) {
    const int index = add_vectors(positions, TINYGLTF_TARGET_ARRAY_BUFFER);
    Vector3f low = positions[0], high = positions[0];
    for (const Vector3f& p : positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    model_.accessors[index].minValues.assign(low.data(), low.data() + 3);
    model_.accessors[index].maxValues.assign(high.data(), high.data() + 3);
    return index;
  }

  void add_material(const GlbMaterial& material) {
    tinygltf::Material out;
    out.name = material.name;
    out.pbrMetallicRoughness.baseColorFactor.assign(material.color.begin(), material.color.end());
    out.pbrMetallicRoughness.metallicFactor = 0;
    out.pbrMetallicRoughness.roughnessFactor = material.roughness;
    out.doubleSided = material.double_sided;
    out.alphaMode = material.color[3] < 1 ? "BLEND" : "OPAQUE";
    model_.materials.push_back(out);
  }

  void add_mesh(const GlbMesh& mesh) {
    numbers_.push_back(mesh.triangles.empty() ? -1 : static_cast<int>(model_.meshes.size()));
    if (mesh.triangles.empty()) return;
    std::vector<std::uint32_t> corners;
    corners.reserve(3 * mesh.triangles.size());
    for (const auto& triangle : mesh.triangles)
      corners.insert(corners.end(), triangle.begin(), triangle.end());
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.material = mesh.material;
    primitive.attributes["POSITION"] = add_positions(mesh.positions);
    primitive.attributes["NORMAL"] = add_vectors(mesh.normals, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.indices = add_numbers(corners, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                    TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    tinygltf::Mesh out;
    out.name = mesh.name;
    out.primitives = {primitive};
    model_.meshes.push_back(out);
  }

  void add_node(const GlbNode& node) {
    tinygltf::Node out;
    out.name = node.name;
    out.mesh = node.mesh < 0 ? -1 : numbers_[static_cast<std::size_t>(node.mesh)];
    out.children = node.children;
    const GlbPlace& place = node.place;
    const Eigen::Quaterniond& q = place.rotation;
    out.translation.assign(place.translation.data(), place.translation.data() + 3);
    out.rotation = {q.x(), q.y(), q.z(), q.w()};
    out.scale.assign(place.scale.data(), place.scale.data() + 3);
    out.extras = extras(node.extras, {});
    model_.nodes.push_back(out);
  }

  static tinygltf::Value extras(const std::vector<GlbNumbers>& numbers,
                                const std::vector<std::pair<std::string, std::string>>& words) {
    tinygltf::Value::Object object;
    for (const auto& [name, text] : words) object[name] = tinygltf::Value(text);
    for (const GlbNumbers& entry : numbers) {
      tinygltf::Value::Array array;
      for (const double value : entry.values) array.emplace_back(value);
      object[entry.name] = tinygltf::Value(std::move(array));
    }
    return object.empty() ? tinygltf::Value() : tinygltf::Value(std::move(object));
  }

  void add_animation() {
    if (document_.times.empty()) return;
    tinygltf::Animation animation;
    animation.name = document_.animation;
    const std::vector<float> times(document_.times.begin(), document_.times.end());
    const int input = add_times(times);
    for (std::size_t i = 0; i < document_.nodes.size(); ++i) {
      if (!document_.nodes[i].track.empty()) animate(animation, static_cast<int>(i), input);
    }
    if (!animation.channels.empty()) model_.animations.push_back(std::move(animation));
  }

  void animate(tinygltf::Animation& animation, int index, int input) {
    const GlbNode& node = document_.nodes[static_cast<std::size_t>(index)];
    assert(node.track.size() == document_.times.size());
    const auto vectors = [&](Eigen::Vector3d GlbPlace::*part) {
      std::vector<Vector3f> values;
      for (const GlbPlace& place : node.track) values.push_back((place.*part).cast<float>());
      return add_vectors(values, 0);
    };
    add_channel(animation, index, "translation", input, vectors(&GlbPlace::translation), "LINEAR");
    add_channel(animation, index, "rotation", input, add_rotations(node.track), "LINEAR");
    if (node.moves_scale)
      add_channel(animation, index, "scale", input, vectors(&GlbPlace::scale), "LINEAR");
    if (!node.steps.empty()) add_steps(animation, index, node.steps);
  }

  void add_steps(tinygltf::Animation& animation, int index, const std::vector<GlbStep>& steps) {
    std::vector<float> times;
    std::vector<Vector3f> scales;
    for (const GlbStep& step : steps) {
      times.push_back(static_cast<float>(step.time));
      scales.emplace_back(Vector3f::Constant(static_cast<float>(step.scale)));
    }
    add_channel(animation, index, "scale", add_times(times), add_vectors(scales, 0), "STEP");
  }

  int add_times(const std::vector<float>& times) {
    const int input = add_numbers(times, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR);
    model_.accessors[input].minValues = {times.front()};
    model_.accessors[input].maxValues = {times.back()};
    return input;
  }

  /// q and -q are the same rotation: the one nearer to its predecessor is taken.
  int add_rotations(const std::vector<GlbPlace>& track) {
    std::vector<float> values;
    Eigen::Quaterniond before = track[0].rotation;
    for (const GlbPlace& place : track) {
      Eigen::Quaterniond q = place.rotation.normalized();
      if (q.dot(before) < 0) q.coeffs() = -q.coeffs();
      before = q;
      for (int k = 0; k < 4; ++k) values.push_back(static_cast<float>(q.coeffs()[k]));
    }
    return add_numbers(values, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4);
  }

  static void add_channel(tinygltf::Animation& animation,
                          int node,
                          const char* path,
                          int input,
                          int output,
                          const char* interpolation) {
    tinygltf::AnimationSampler sampler;
    sampler.input = input;
    sampler.output = output;
    sampler.interpolation = interpolation;
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size());
    channel.target_node = node;
    channel.target_path = path;
    animation.samplers.push_back(sampler);
    animation.channels.push_back(channel);
  }

  const GlbDocument& document_;
  tinygltf::Model model_;
  std::vector<int> numbers_;  ///< index in the file of each mesh, -1 where it is left out
};

}  // namespace

std::string glb_bytes(const GlbDocument& document) { return GlbWriter(document).bytes(); }

}  // namespace condyle
