#include "condyle/specimen/strands_in_bone.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "condyle/math/degree.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/specimen/bone_string.h"
#include "condyle/specimen/fit_wraps.h"
#include "condyle/specimen/preset_flexion.h"

namespace condyle {
namespace {

bool wraps_on(const Scene& scene, const LigamentDescription& ligament, int body) {
  return std::any_of(ligament.path.wraps.begin(), ligament.path.wraps.end(), [&](int wrap) {
    return scene.wraps[static_cast<std::size_t>(wrap)].body == body;
  });
}

/// Deeper by `limit` than its own insertion lies; a depth of 0 where it is not.
StrandInBone deepest(const Scene& scene,
                     const std::vector<PresetPose>& poses,
                     const SmoothedMesh& bone,
                     double limit,
                     int ligament,
                     int body) {
  StrandInBone strand{ligament, body, 0, 0};
  for (const PresetPose& pose : poses) {
    const auto [own, far] =
        ends_seen_from(scene, scene.ligaments[static_cast<std::size_t>(ligament)], body, pose.X_BA);
    if (bone.signed_distance(far) < 0) continue;
    const double depth = depth_of_line(bone, own, far);
    const double inserted = std::max(0.0, -bone.signed_distance(own));
    if (depth > inserted + limit && depth > strand.depth)
      strand.flexion = pose.flexion, strand.depth = depth;
  }
  return strand;
}

/// A file may hold both bones; which of its parts is which is not told.
bool shares_mesh(const Scene& scene, std::size_t body) {
  const std::optional<MeshFile>& mesh = scene.bodies[body].mesh;
  for (std::size_t b = 0; mesh && b < scene.bodies.size(); ++b)
    if (b != body && scene.bodies[b].mesh && scene.bodies[b].mesh->is(*mesh)) return true;
  return false;
}

void warn_of_strands(const Scene& scene,
                     const std::vector<TriangleMesh>& bones,
                     double limit,
                     std::vector<std::string>& lines) {
  std::vector<std::size_t> untold;
  const std::vector<StrandInBone> strands = strands_in_bone(scene, bones, limit, &untold);
  for (const std::size_t b : untold)
    lines.push_back(fmt::format("ligaments straight through \"{}\" are not looked for: its mesh {}",
                                scene.bodies[b].name,
                                shares_mesh(scene, b) ? "holds another bone, too" : "is open"));
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    std::string names;
    int count = 0;
    for (const StrandInBone& strand : strands) {
      if (strand.body != static_cast<int>(b)) continue;
      names += fmt::format("{}\"{}\" ({:.1f} mm {}at {:.0f} deg{})", count > 0 ? ", " : "",
                           scene.ligaments[static_cast<std::size_t>(strand.ligament)].name,
                           strand.depth, count > 0 ? "" : "deep ", strand.flexion / kDegree,
                           count > 0 ? "" : " of flexion from the start pose");
      ++count;
    }
    if (count > 0)
      lines.push_back(fmt::format(
          "warning: straight through \"{}\" go {}; "
          "[[wrap]] body = \"{}\", kind = \"ellipsoid\", fit = \"bone\" leads them round, with a "
          "name that is in their wraps = [..]",
          scene.bodies[b].name, names, scene.bodies[b].name));
  }
}

void warn_of_deep_ends(const Scene& scene, double limit, std::vector<std::string>& lines) {
  for (const LigamentDescription& ligament : scene.ligaments) {
    if (ligament.path.wraps.empty() || !ligament.path.anchors_inside) continue;
    const std::vector<PathWrap> wraps = path_wraps(scene, ligament);
    const auto [x_C, s_D] = fixed_then_moving(scene, ligament.ends);
    for (const InsideEnd& end : inside_ends(wraps, x_C, s_D))
      if (end.wrap >= 0 && end.depth > limit)
        lines.push_back(
            fmt::format("warning: ligament \"{}\": its insertion lies {:.1f} mm inside wrap \"{}\" "
                        "and is moved "
                        "to its surface",
                        ligament.name, end.depth, wraps[static_cast<std::size_t>(end.wrap)].name));
  }
}

void warn_of_fits(const Scene& scene, std::vector<std::string>& lines) {
  constexpr double kPoor = 0.3;  // of a length [mm]
  for (const WrapDescription& wrap : scene.wraps)
    if (wrap.fit && wrap.fit->length_max > kPoor)
      lines.push_back(
          fmt::format("warning: wrap \"{}\": a string over it is {:.2f} mm longer or shorter than "
                      "over the mesh, expected at most {:g} mm: fewer ligaments on one ellipsoid",
                      wrap.name, wrap.fit->length_max, kPoor));
}

/// Ligaments that end on a body and wrap on nothing of it.
std::vector<int> straight_at(const Scene& scene, int body) {
  std::vector<int> found;
  for (std::size_t i = 0; i < scene.ligaments.size(); ++i) {
    const LigamentDescription& ligament = scene.ligaments[i];
    if ((ligament.ends[0].body == body || ligament.ends[1].body == body) &&
        !wraps_on(scene, ligament, body))
      found.push_back(static_cast<int>(i));
  }
  return found;
}

}  // namespace

std::vector<StrandInBone> strands_in_bone(const Scene& scene,
                                          const std::vector<TriangleMesh>& bones,
                                          double limit,
                                          std::vector<std::size_t>* untold) {
  std::vector<StrandInBone> strands;
  if (scene.moving_body() < 0) return strands;
  const std::vector<PresetPose> poses = preset_poses(scene);
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const auto body = static_cast<int>(b);
    const std::vector<int> straight = straight_at(scene, body);
    if (straight.empty() || bones[b].triangles.empty()) continue;
    std::optional<TriangleMesh> solid;
    if (!shares_mesh(scene, b)) solid = solid_bone(bones[b]);
    if (!solid) {
      if (untold != nullptr) untold->push_back(b);
      continue;
    }
    const SmoothedMesh bone(*solid);
    for (const int ligament : straight) {
      const StrandInBone strand = deepest(scene, poses, bone, limit, ligament, body);
      if (strand.depth > 0) strands.push_back(strand);
    }
  }
  return strands;
}

std::vector<std::string> wrap_warnings(const Scene& scene,
                                       const std::vector<TriangleMesh>& bones,
                                       double limit) {
  std::vector<std::string> lines;
  warn_of_fits(scene, lines);
  warn_of_strands(scene, bones, limit, lines);
  warn_of_deep_ends(scene, limit, lines);
  return lines;
}

}  // namespace condyle
