#include "strangers/stranger_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <random>

#include "condyle/input_error.h"
#include "condyle/math/rotation.h"
#include "condyle/mesh/clean_mesh.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh_files/load_mesh.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle::strangers {
namespace {

using Eigen::Vector3d;
using Meshes = std::map<std::filesystem::path, TriangleMesh>;

std::string text(const Vector3d& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
}

/// Each mesh once; those of a body are moved with it.
template <typename Use>
void for_meshes_of(const Scene& scene, int body, const Use& use) {
  std::vector<std::filesystem::path> seen;
  const auto once = [&](const std::optional<MeshFile>& mesh) {
    if (!mesh || std::find(seen.begin(), seen.end(), mesh->path) != seen.end()) return;
    seen.push_back(mesh->path);
    use(*mesh);
  };
  once(scene.bodies[static_cast<std::size_t>(body)].mesh);
  for (const SurfaceDescription& surface : scene.surfaces)
    if (surface.body == body) once(surface.patch.mesh);
}

void move_frame(AnatomicalFrame& frame, int body, const RigidTransform& X) {
  if (frame.body != body) return;
  frame.origin = X * frame.origin;
  for (Vector3d* direction : {&frame.lateral, &frame.anterior, &frame.proximal})
    *direction = X.R * *direction;
}

std::string frame_text(const Scene& scene, const char* name, const AnatomicalFrame& frame) {
  return fmt::format(
      "{} = {{ body = \"{}\", origin = {}, lateral = {}, anterior = {}, proximal = {} }}\n", name,
      scene.bodies[static_cast<std::size_t>(frame.body)].name, text(frame.origin),
      text(frame.lateral), text(frame.anterior), text(frame.proximal));
}

std::string bodies_text(const Scene& scene,
                        const std::map<std::filesystem::path, std::string>& file) {
  std::string out;
  for (const BodyDescription& body : scene.bodies) {
    out += fmt::format("\n[[body]]\nname = \"{}\"\n", body.name);
    if (body.mesh) out += fmt::format("mesh = \"{}\"\n", file.at(body.mesh->path));
    if (body.fixed) {
      out += "fixed = true\n";
      continue;
    }
    const RigidTransform start = start_pose(scene);
    out += fmt::format("start.translation = {}\nstart.rotation = {}\n", text(start.p),
                       text(log_rotation(start.R) * 180 / M_PI));
  }
  if (scene.joint)
    out += fmt::format("\n[joint]\nside = \"{}\"\n",
                       scene.joint->side == Side::kRight ? "right" : "left") +
           frame_text(scene, "femur", scene.joint->femur) +
           frame_text(scene, "tibia", scene.joint->tibia);
  return out;
}

std::string surfaces_text(const Scene& scene,
                          const std::map<std::filesystem::path, std::string>& file) {
  std::string out;
  for (const SurfaceDescription& surface : scene.surfaces) {
    if (surface.kind != SurfaceKind::kPatch || !surface.patch.compartment)
      throw InputError(
          fmt::format("surface \"{}\": expected a patch of a compartment", surface.name));
    out += fmt::format(
        "\n[[surface]]\nname = \"{}\"\nbody = \"{}\"\nkind = \"patch\"\n"
        "compartment = \"{}\"\n",
        surface.name, scene.bodies[static_cast<std::size_t>(surface.body)].name,
        *surface.patch.compartment == Compartment::kMedial ? "medial" : "lateral");
    if (surface.patch.mesh)
      out += fmt::format("mesh = \"{}\"\n", file.at(surface.patch.mesh->path));
    std::string fit;
    if (surface.patch.smoothing) fit = fmt::format("smoothing = {:.17g}", *surface.patch.smoothing);
    if (surface.patch.smooth_for_position) fit = "smoothing = \"position\"";
    if (surface.patch.control_points)
      fit += fmt::format("{}control_points = [{}, {}]", fit.empty() ? "" : ", ",
                         (*surface.patch.control_points)[0], (*surface.patch.control_points)[1]);
    if (!fit.empty()) out += "fit = { " + fit + " }\n";
  }
  for (const ContactDescription& contact : scene.contacts)
    out += fmt::format("\n[[contact]]\nname = \"{}\"\nsurfaces = [\"{}\", \"{}\"]\n", contact.name,
                       scene.surfaces[static_cast<std::size_t>(contact.surfaces[0])].name,
                       scene.surfaces[static_cast<std::size_t>(contact.surfaces[1])].name);
  return out;
}

std::string elements_text(const Scene& scene) {
  std::string out;
  const auto body = [&](int i) { return scene.bodies[static_cast<std::size_t>(i)].name; };
  for (const LigamentDescription& ligament : scene.ligaments) {
    const auto* law = std::get_if<ToeLinearLaw>(&ligament.law);
    if (law == nullptr)
      throw InputError(
          fmt::format("ligament \"{}\": expected law = \"toe-linear\"", ligament.name));
    out += fmt::format(
        "\n[[ligament]]\nname = \"{}\"\nends = [{{ body = \"{}\", at = {} }}, {{ body = \"{}\", at "
        "= {} }}]\nlaw = \"toe-linear\"\nstiffness = {:.17g}\ntransition_strain = "
        "{:.17g}\nslack_length = {:.17g}\n",
        ligament.name, body(ligament.ends[0].body), text(ligament.ends[0].at),
        body(ligament.ends[1].body), text(ligament.ends[1].at), law->stiffness,
        law->transition_strain, law->slack_length);
  }
  for (const ConditionDescription& condition : scene.conditions) {
    if (condition.kind != ConditionKind::kFlexion)
      throw InputError(
          fmt::format("condition \"{}\": expected kind = \"flexion\"", condition.name));
    out += fmt::format("\n[[condition]]\nname = \"{}\"\nkind = \"flexion\"\nvalue = {:.17g}\n",
                       condition.name, condition.value * 180 / M_PI);
  }
  for (const LoadDescription& load : scene.loads) {
    out += fmt::format(
        "\n[[load]]\nname = \"{}\"\nbody = \"{}\"\nkind = \"{}\"\nvector = {}\n"
        "follows = \"{}\"\n",
        load.name, body(load.body), load.moment ? "moment" : "force", text(load.vector),
        load.follows_body ? "body" : "ground");
    if (!load.moment) out += fmt::format("at = {}\n", text(load.at));
  }
  return out;
}

template <typename Number>
void put(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

/// Binary, doubles: what was moved by metres loses nothing.
void write_ply(const std::filesystem::path& path, const TriangleMesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double "
      "y\nproperty double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  for (const Vector3d& vertex : mesh.vertices)
    for (const double x : vertex) put(bytes, x);
  for (const std::array<int, 3>& triangle : mesh.triangles) {
    put(bytes, static_cast<unsigned char>(3));
    for (const int corner : triangle) put(bytes, static_cast<std::int32_t>(corner));
  }
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

Knee read_knee(const std::string& name, const std::filesystem::path& scene) {
  Knee knee{name, read_scene(scene), {}};
  for (std::size_t body = 0; body < knee.scene.bodies.size(); ++body)
    for_meshes_of(knee.scene, static_cast<int>(body), [&](const MeshFile& file) {
      knee.meshes[file.path] = clean_mesh(load_mesh(file.path, file.to_mm)).mesh;
    });
  return knee;
}

void load_with(Knee& knee, double newton) {
  double first = 0;
  for (LoadDescription& load : knee.scene.loads) {
    if (load.moment) continue;
    if (first == 0) first = load.vector.norm();
    if (first > 0) load.vector *= newton / first;
  }
}

void move_body(Knee& knee, int body, const RigidTransform& X) {
  Scene& scene = knee.scene;
  const RigidTransform start = start_pose(scene);
  const bool fixed = body == scene.fixed_body();
  for_meshes_of(scene, body, [&](const MeshFile& file) {
    for (Vector3d& vertex : knee.meshes.at(file.path).vertices) vertex = X * vertex;
  });
  if (scene.joint) {
    move_frame(scene.joint->femur, body, X);
    move_frame(scene.joint->tibia, body, X);
  }
  for (LigamentDescription& ligament : scene.ligaments)
    for (Attachment& end : ligament.ends)
      if (end.body == body) end.at = X * end.at;
  for (LoadDescription& load : scene.loads) {
    if (load.body == body) load.at = X * load.at;
    // A dead load turns with the ground, a follower with its body.
    if (load.follows_body ? load.body == body : fixed) load.vector = X.R * load.vector;
  }
  BodyDescription& moving = scene.bodies[static_cast<std::size_t>(scene.moving_body())];
  const RigidTransform moved = fixed ? X * start : start * X.inverse();
  moving.start_joint_angles.reset();
  moving.start_translation = moved.p;
  moving.start_rotation = log_rotation(moved.R);
}

void roughen(Knee& knee, double rms, double correlation, std::uint64_t seed) {
  constexpr int kWaves = 400;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0, 1 / correlation);
  std::uniform_real_distribution<double> turn(0, 2 * M_PI);
  for (auto& [path, mesh] : knee.meshes) {
    std::vector<Vector3d> waves;
    std::vector<double> phases;
    for (int w = 0; w < kWaves; ++w) {
      const double x = normal(random), y = normal(random), z = normal(random);
      waves.emplace_back(x, y, z);
      phases.push_back(turn(random));
    }
    const std::vector<Vector3d> normals = vertex_normals(mesh);
    // The mean square of a sum of n waves is n/2.
    const double scale = rms * std::sqrt(2.0 / kWaves);
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      double sum = 0;
      for (std::size_t w = 0; w < waves.size(); ++w)
        sum += std::cos(waves[w].dot(mesh.vertices[i]) + phases[w]);
      mesh.vertices[i] += scale * sum * normals[i];
    }
  }
}

std::filesystem::path write_knee(const Knee& knee, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::map<std::filesystem::path, std::string> file;
  for (const auto& [path, mesh] : knee.meshes) {
    file[path] = fmt::format("{}_{}.ply", file.size(), path.stem().string());
    write_ply(folder / file[path], mesh);
  }
  const Scene& scene = knee.scene;
  const std::string content = fmt::format(
                                  "title = \"{}\"\n\n[units]\nlength = \"mm\"\nangle = \"deg\"\n"
                                  "force = \"N\"\n",
                                  knee.name) +
                              bodies_text(scene, file) + surfaces_text(scene, file) +
                              elements_text(scene) + "\n[sweep]\nvary = \"" + scene.sweep->vary +
                              "\"\nfrom = 0\nto = 120\nstep = 5\n";
  std::ofstream(folder / "knee.toml") << content;
  return folder / "knee.toml";
}

}  // namespace condyle::strangers
