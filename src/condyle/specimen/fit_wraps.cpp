#include "condyle/specimen/fit_wraps.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "condyle/elements/line_element.h"
#include "condyle/input_error.h"
#include "condyle/mesh/mesh_edges.h"
#include "condyle/mesh/mesh_measures.h"
#include "condyle/mesh/orient_mesh.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene/scene_place.h"
#include "condyle/specimen/bone_string.h"
#include "condyle/specimen/fit_ellipsoid.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/specimen/preset_flexion.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

/// A string that touches the bone, in the bone's frame.
struct Strand {
  int ligament;
  double flexion;
  std::array<Vector3d, 2> ends;  ///< that on the bone first
  BonePath path;
};

const std::string& body_of(const Scene& scene, const WrapDescription& wrap) {
  return scene.bodies[static_cast<std::size_t>(wrap.body)].name;
}

[[noreturn]] void refuse(const Scene& scene, const WrapDescription& wrap, const std::string& why) {
  throw InputError(fmt::format("{}: {}", place_of(scene, wrap), why));
}

/// Poses in which the far end would lie in the bone are none.
std::vector<Strand> strands_of(const Scene& scene,
                               const WrapDescription& wrap,
                               const SmoothedMesh& bone) {
  constexpr double kDeepest = 1;  // [mm]
  std::vector<Strand> strands;
  const std::vector<PresetPose> poses = preset_poses(scene);
  for (const int ligament : wrap.fit->ligaments)
    for (const PresetPose& pose : poses) {
      Strand strand{ligament, pose.flexion, {}, {}};
      strand.ends = ends_seen_from(scene, scene.ligaments[static_cast<std::size_t>(ligament)],
                                   wrap.body, pose.X_BA);
      if (bone.signed_distance(strand.ends[1]) < -kDeepest) continue;
      strand.path = bone_string(bone, strand.ends[0], strand.ends[1]);
      if (strand.path.found && !strand.path.touches.empty()) strands.push_back(std::move(strand));
    }
  return strands;
}

/// Near a touched point and facing the same way.
std::vector<Vector3d> touched_vertices(const SmoothedMesh& bone,
                                       const std::vector<Strand>& strands,
                                       double region,
                                       double least_cosine) {
  std::vector<Vector3d> vertices;
  const auto touched = [&](const Vector3d& p, const Vector3d& n) {
    for (const Strand& strand : strands)
      for (const StringTouch& touch : strand.path.touches)
        if ((touch.point - p).squaredNorm() < region * region && touch.normal.dot(n) > least_cosine)
          return true;
    return false;
  };
  for (std::size_t i = 0; i < bone.mesh().vertices.size(); ++i)
    if (touched(bone.mesh().vertices[i], bone.normals()[i]))
      vertices.push_back(bone.mesh().vertices[i]);
  return vertices;
}

/// The middle of what is touched: axes along the strings, across them, and out of the bone.
RigidTransform middle_of(const std::vector<Strand>& strands) {
  Vector3d point = Vector3d::Zero(), normal = point, along = point;
  double count = 0;
  for (const Strand& strand : strands)
    for (const StringTouch& touch : strand.path.touches) {
      point += touch.point;
      normal += touch.normal;
      along += strand.ends[1] - strand.ends[0];
      ++count;
    }
  RigidTransform X;
  const Vector3d n = normal.norm() > 0 ? Vector3d(normal.normalized()) : Vector3d::UnitZ();
  const Vector3d across = n.cross(along);
  X.R.col(1) = across.norm() > 1e-6 * along.norm() ? Vector3d(across.normalized())
                                                   : Vector3d(n.unitOrthogonal());
  X.R.col(2) = n;
  X.R.col(0) = X.R.col(1).cross(n);
  X.p = point / count;
  return X;
}

/// 0 where there is no path.
double length_over(const WrapDescription& wrap, const std::array<Vector3d, 2>& ends) {
  const PathWrap surface{wrap.name, wrap.shape, wrap.placement, false, wrap.fit->side};
  const LineElement element{ends[0], ends[1], {}, make_wrapped_path({surface}, ends[0], ends[1])};
  return line_element_state(element, RigidTransform{}).length;
}

void compare_lengths(const std::vector<Strand>& strands, WrapDescription& wrap) {
  BoneFit& fit = *wrap.fit;
  double squares = 0;
  int count = 0;
  for (const Strand& strand : strands) {
    const double fitted = length_over(wrap, strand.ends);
    fit.strings.push_back({strand.ligament, strand.flexion, strand.path.straight, strand.path.depth,
                           strand.path.length, fitted});
    if (!(fitted > 0)) continue;
    const double error = std::abs(fitted - strand.path.length);
    squares += error * error;
    fit.length_max = std::max(fit.length_max, error);
    ++count;
  }
  fit.length_rms = count > 0 ? std::sqrt(squares / count) : 0;
}

bool is_good(const EllipsoidFit& fit, const WrapFitOptions& options) {
  return fit.found && fit.rms <= options.most_rms &&
         fit.semi_axes.maxCoeff() <= options.most_semi_axis;
}

std::string in_words(const EllipsoidFit& fit, int vertices, const WrapFitOptions& options) {
  const Vector3d& a = fit.semi_axes;
  return fmt::format(
      "semi-axes {:.4g}, {:.4g}, {:.4g} mm, {:.2f} mm rms and up to {:.2f} mm off {} vertices, "
      "expected "
      "at most {:g} mm rms and semi-axes of at most {:g} mm: fewer ligaments, or a torus or an "
      "ellipsoid given by hand",
      a.x(), a.y(), a.z(), fit.rms, fit.max, vertices, options.most_rms, options.most_semi_axis);
}

/// To what lies within the least region where that can be done; the first refusal is told.
EllipsoidFit good_ellipsoid(const Scene& scene,
                            const SmoothedMesh& bone,
                            const std::vector<Strand>& strands,
                            const WrapFitOptions& options,
                            WrapDescription& wrap) {
  constexpr double kRadius = 14;      // of the first estimate [mm]
  constexpr std::size_t kLeast = 20;  // vertices for nine unknowns
  const RigidTransform middle = middle_of(strands);
  RigidTransform start = middle;
  start.p -= kRadius * middle.R.col(2);
  wrap.fit->side = middle.p + kRadius * middle.R.col(2);
  std::string refusal;
  for (const double region : options.regions) {
    const std::vector<Vector3d> vertices =
        touched_vertices(bone, strands, region, options.least_cosine);
    if (vertices.size() < kLeast) continue;
    EllipsoidFit ellipsoid = fit_ellipsoid(vertices, start, kRadius);
    wrap.fit->region = region;
    wrap.fit->vertices = static_cast<int>(vertices.size());
    if (is_good(ellipsoid, options)) return ellipsoid;
    if (refusal.empty()) refusal = in_words(ellipsoid, wrap.fit->vertices, options);
  }
  if (refusal.empty())
    refuse(scene, wrap,
           fmt::format("fit = \"bone\": the mesh of \"{}\" has less than {} vertices where strings "
                       "touch it, expected a finer mesh",
                       body_of(scene, wrap), kLeast));
  refuse(scene, wrap,
         fmt::format("fit = \"bone\": no ellipsoid is near \"{}\" where strings touch it: {}",
                     body_of(scene, wrap), refusal));
}

void fit_wrap(const Scene& scene,
              const SmoothedMesh& bone,
              const WrapFitOptions& options,
              WrapDescription& wrap) {
  const std::vector<Strand> strands = strands_of(scene, wrap, bone);
  if (strands.empty())
    refuse(
        scene, wrap,
        fmt::format("fit = \"bone\": no string of its ligaments touches \"{}\" at the start pose "
                    "or flexed from there, expected a body that is in their way",
                    body_of(scene, wrap)));
  const EllipsoidFit ellipsoid = good_ellipsoid(scene, bone, strands, options, wrap);
  BoneFit& fit = *wrap.fit;
  wrap.shape = WrapEllipsoid{ellipsoid.semi_axes};
  wrap.placement = ellipsoid.placement;
  fit.rms = ellipsoid.rms;
  fit.max = ellipsoid.max;
  fit.done = true;
  compare_lengths(strands, wrap);
}

bool asks_for(const Scene& scene, std::size_t body) {
  return std::any_of(scene.wraps.begin(), scene.wraps.end(), [&](const WrapDescription& wrap) {
    return wrap.fit && !wrap.fit->done && wrap.body == static_cast<int>(body);
  });
}

}  // namespace

std::optional<TriangleMesh> solid_bone(const TriangleMesh& bone) {
  if (bone.triangles.empty()) return std::nullopt;
  TriangleMesh mesh = bone;
  const TriangleLinks links(mesh);
  const std::vector<int> component = find_components(mesh, links);
  std::vector<bool> closed;
  orient_components(mesh, links, component, closed);
  if (closed.empty() || !closed[0]) return std::nullopt;
  if (closed.size() == 1) return mesh;
  std::vector<bool> largest;
  for (const int c : component) largest.push_back(c == 0);
  return sub_mesh(mesh, largest).mesh;
}

void fit_wraps(Scene& scene,
               const std::vector<TriangleMesh>& bones,
               const WrapFitOptions& options) {
  bool any = false;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (!asks_for(scene, b)) continue;
    any = true;
    const std::optional<TriangleMesh> solid = solid_bone(bones[b]);
    std::optional<SmoothedMesh> bone;
    if (solid) bone.emplace(*solid);
    for (WrapDescription& wrap : scene.wraps) {
      if (!wrap.fit || wrap.fit->done || wrap.body != static_cast<int>(b)) continue;
      if (!bone)
        refuse(
            scene, wrap,
            fmt::format("fit = \"bone\": the mesh of \"{}\" does not enclose a volume, expected a "
                        "closed one",
                        body_of(scene, wrap)));
      fit_wrap(scene, *bone, options, wrap);
    }
  }
  if (any) settle_fitted_paths(scene);
}

void fit_wraps(Scene& scene, const std::vector<FittedSurface>& surfaces) {
  std::vector<TriangleMesh> bones(scene.bodies.size());
  for (std::size_t b = 0; b < bones.size(); ++b)
    if (asks_for(scene, b)) bones[b] = body_mesh(scene, static_cast<int>(b), surfaces);
  fit_wraps(scene, bones);
}

std::vector<std::string> describe_wrap_fits(const Scene& scene) {
  std::vector<std::string> lines;
  for (const WrapDescription& wrap : scene.wraps) {
    if (!wrap.fit || !wrap.fit->done) continue;
    const BoneFit& fit = *wrap.fit;
    const Vector3d& a = std::get<WrapEllipsoid>(wrap.shape).semi_axes;
    lines.push_back(
        fmt::format("wrap \"{}\": ellipsoid of semi-axes {:.4g}, {:.4g}, {:.4g} mm on \"{}\", "
                    "{:.2f} mm rms and "
                    "{:.2f} mm at most off the {} vertices within {:g} mm of {} strings; strings "
                    "over it differ "
                    "from those over the mesh by {:.3f} mm rms, {:.3f} mm at most",
                    wrap.name, a.x(), a.y(), a.z(), body_of(scene, wrap), fit.rms, fit.max,
                    fit.vertices, fit.region, fit.strings.size(), fit.length_rms, fit.length_max));
  }
  return lines;
}

}  // namespace condyle
