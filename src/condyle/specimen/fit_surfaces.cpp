#include "condyle/specimen/fit_surfaces.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "condyle/input_error.h"
#include "condyle/mesh/clean_mesh.h"
#include "condyle/scene/scene_place.h"
#include "condyle/specimen/check_layers.h"
#include "condyle/specimen/fit_keys.h"
#include "condyle/specimen/patch_sources.h"
#include "condyle/start_threads.h"
#include "condyle/surface/exact_surfaces.h"
#include "condyle/surface/fit_figures.h"
#include "condyle/surface/fit_patch.h"
#include "condyle/surface/offset_patch.h"
#include "condyle/surface/patch.h"

namespace condyle {
namespace {

/// That the known part of a patch with a layer goes on beyond that of one with points of contact,
/// but for limits that the scene sets: an area spreads from where a point would be [mm].
constexpr double kAreaBeyondPoint = 4;

/// What was mended of a body's mesh; "warning: " stays in front.
std::string of_body(const std::string& body, const std::string& note) {
  const std::string warning = note.starts_with("warning: ") ? "warning: " : "";
  return fmt::format("{}body \"{}\": {}", warning, body, note.substr(warning.size()));
}

ArticularRegion find_region(const Scene& scene,
                            const PatchSource& source,
                            const PatchDescription& patch,
                            bool layered) {
  const TriangleMesh& mesh = source.shape;
  std::optional<std::array<Eigen::Vector3d, 2>> box = patch.region_box;
  if (box)
    for (Eigen::Vector3d& corner : *box) corner -= source.middle;
  if (!patch.compartment) return box_region(mesh, *box);
  RegionOptions options;
  options.box = box;
  if (layered && !patch.region_angles && !patch.region_least_cosine)
    options.beyond = kAreaBeyondPoint;
  if (patch.region_angles) {
    options.femur_first_angle = (*patch.region_angles)[0];
    options.femur_last_angle = (*patch.region_angles)[1];
  }
  if (patch.region_least_cosine)
    options.femur_least_cosine = options.tibia_least_cosine = *patch.region_least_cosine;
  const Half half = *patch.compartment == Compartment::kMedial ? Half::kMedial : Half::kLateral;
  if (source.axis) return femoral_region(mesh, *source.axis, half, options);
  return tibial_region(mesh, bone_frame(scene.joint->tibia, source), half, options);
}

/// Where one vertex lies much farther off the patch than most, it is the mesh that is to be mended.
std::string remedy(const FitFigures& figures,
                   const ArticularRegion& region,
                   const Eigen::Vector3d& moved) {
  constexpr double kSpike = 6;  // of the distance that 95 % keep
  if (figures.core_farthest < 0 || figures.core_max < kSpike * figures.p95)
    return "more control points or less smoothing";
  const Eigen::Vector3d at =
      region.mesh.vertices[static_cast<std::size_t>(figures.core_farthest)] + moved;
  return fmt::format("is there a spike in the mesh at [{:.1f}, {:.1f}, {:.1f}] mm?", at.x(), at.y(),
                     at.z());
}

/// `moved`: from the frame of the region to that of the file [mm].
FitReport report_of(const std::string& name,
                    const ArticularRegion& region,
                    const PatchFit& fit,
                    const Eigen::Vector3d& moved) {
  const FitFigures figures = measure_fit(region, fit);
  FitReport report;
  report.surface = name;
  report.mesh_vertices = static_cast<int>(region.mesh.vertices.size());
  report.control_points = {fit.patch.nu, fit.patch.nv};
  report.smoothing_length = fit.smoothing_length;
  report.rms = figures.rms;
  report.p95 = figures.p95;
  report.max = figures.max;
  report.core_rms = figures.core_rms;
  report.core_max = figures.core_max;
  report.normal_rms = figures.core_normal_rms;
  report.curvature_range = figures.curvature_range;
  report.condition = fit.condition;
  report.back_rms = figures.back_rms;
  report.back_p95 = figures.back_p95;
  report.back_max = figures.back_max;
  report.extent = figures.extent;
  report.turn = figures.turn;
  report.area = figures.area;
  if (figures.folded > 0)
    report.notes.push_back(
        fmt::format("warning: fold: the patch faces away from the mesh at {} of {} vertices",
                    figures.folded, report.mesh_vertices));
  constexpr double kPoor = 0.3;  // as much as a rough segmentation leaves in a smooth patch [mm]
  if (figures.core_rms > kPoor)
    report.notes.push_back(fmt::format(
        "warning: poor fit: {:.2f} mm rms and up to {:.2f} mm off the mesh away from its "
        "edge, expected at most {:g} mm rms: {}",
        figures.core_rms, figures.core_max, kPoor, remedy(figures, region, moved)));
  report.sheet_below = region.sheet_below;
  if (region.sheet_below > 0)
    report.notes.push_back(
        fmt::format("warning: two sheets: the mesh has another surface {:.1f} mm below, as of a "
                    "bone under its cartilage, which is "
                    "left out: expected one of them",
                    region.sheet_below));
  constexpr double kThin = 4;  // [mm]
  if (figures.depth < kThin)
    report.notes.push_back(
        fmt::format("warning: thin region: nowhere farther than {:.1f} mm from its edge, expected "
                    "at least {:.0f} mm",
                    figures.depth, kThin));
  return report;
}

/// Moves patch and region; says how well.
std::string move_out(double offset, ArticularRegion& region, PatchFit& fit) {
  OffsetPatch moved = offset_patch(region, fit, offset);
  fit.patch = std::move(moved.patch);
  region.mesh = std::move(moved.region);
  return fmt::format(
      "moved {:g} mm out of the bone; the spline lies {:.4f} mm rms, {:.4f} mm at most, from the "
      "surface at that distance",
      offset, moved.rms, moved.max);
}

std::string words_of(const WideHoles& holes,
                     const TriangleMesh& region,
                     const Eigen::Vector3d& moved) {
  const Eigen::Vector3d at = holes.middle + moved;
  return fmt::format(
      "warning: hole: {} in the region left out, the widest {:.0f} mm round at [{:.1f}, {:.1f}, "
      "{:.1f}] mm: contacts there are told as beyond an edge; those up to {:.0f} mm round are "
      "bridged",
      holes.count == 1 ? "one" : fmt::format("{}", holes.count), holes.perimeter, at.x(), at.y(),
      at.z(), bridged_perimeter(region));
}

/// Adds to an error of `work` what `keys` says of the scene.
template <typename Work, typename Words>
auto naming_keys(const Work& work, const Words& keys) {
  try {
    return work();
  } catch (const InputError& error) {
    const std::string said = error.what();
    if (said.find("expected") != std::string::npos) throw;
    throw InputError(fmt::format("{}: {}", said, keys()));
  }
}

FittedSurface fit_one(const Scene& scene, const PatchSource& source, int index) {
  const SurfaceDescription& surface = scene.surfaces[index];
  const auto start = std::chrono::steady_clock::now();
  try {
    const bool layered = carries_layer(scene, index);
    ArticularRegion region =
        naming_keys([&] { return find_region(scene, source, surface.patch, layered); },
                    [&] { return region_keys(surface.patch, scene); });
    FitOptions options;
    options.to_the_edge = layered;
    options.control_points = surface.patch.control_points;
    options.smoothing_length = surface.patch.smoothing;
    if (surface.patch.smooth_for_position) options.aim = SmoothingAim::kPositions;
    options.degree = surface.patch.degree;
    PatchFit fit = naming_keys([&] { return fit_patch(region, options); },
                               [&] { return fit_keys(surface.patch, scene); });
    FitReport report = report_of(surface.name, region, fit, source.middle);
    for (const std::vector<std::string>& notes : {source.notes, region.notes, fit.notes})
      report.notes.insert(report.notes.end(), notes.begin(), notes.end());
    if (fit.holes.count > 0)
      report.notes.push_back(words_of(fit.holes, region.mesh, source.middle));
    if (surface.patch.offset > 0)
      report.notes.push_back(move_out(surface.patch.offset, region, fit));
    report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (Eigen::Vector3d& p : fit.patch.control_points) p += source.middle;
    shift(region.mesh, source.middle);
    return {std::make_shared<const Patch>(std::move(fit.patch)),
            std::move(report),
            std::move(region.mesh),
            {}};
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {} ({})", place_of(scene, surface), error.what(),
                                 source.file.path.lexically_normal().string()));
  }
}

void fit_source(const Scene& scene,
                const MeshReader& read,
                PatchSource& source,
                std::vector<FittedSurface>& surfaces,
                const std::function<void()>& on_patch) {
  load_source(scene, read, source);
  for (const int i : source.surfaces) {
    surfaces[i] = fit_one(scene, source, i);
    on_patch();
  }
  if (source.turned) return;
  shift(source.mesh.mesh, source.middle);
  const auto bone = std::make_shared<const TriangleMesh>(std::move(source.mesh.mesh));
  for (const int i : source.surfaces)
    if (!scene.surfaces[i].patch.mesh) surfaces[i].bone = bone;
}

/// Work for all sources on one or two threads, the first error rethrown: sources share nothing but their
/// own places in `surfaces`.
void fit_sources(const Scene& scene,
                 const MeshReader& read,
                 std::vector<PatchSource>& sources,
                 std::vector<FittedSurface>& surfaces,
                 const OnProgress& on_patch,
                 int threads) {
  std::vector<std::exception_ptr> errors(sources.size());
  int done = 0, total = 0;
  for (const PatchSource& source : sources) total += static_cast<int>(source.surfaces.size());
  std::mutex one_at_a_time;
  const auto tell = [&] {
    const std::lock_guard lock(one_at_a_time);
    ++done;
    if (on_patch) on_patch(done, total);
  };
  std::atomic<std::size_t> next = 0;
  const auto work = [&](int) {
    for (std::size_t k = next++; k < sources.size(); k = next++) {
      try {
        fit_source(scene, read, sources[k], surfaces, tell);
      } catch (...) {
        errors[k] = std::current_exception();
      }
    }
  };
  {
    const auto others = start_threads(1, threads, work);
    work(0);
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace

std::unique_ptr<Surface> make_exact_surface(const SurfaceDescription& s) {
  switch (s.kind) {
    case SurfaceKind::kPlane:
      return make_plane(s.point, s.direction, s.known_radius);
    case SurfaceKind::kSphere:
      return make_sphere(s.point, s.radius, s.solid_inside);
    case SurfaceKind::kCylinder:
      return make_cylinder(s.point, s.direction, s.radius, s.solid_inside, s.length);
    case SurfaceKind::kEllipsoid:
      return make_ellipsoid(s.point, s.axes, s.semi_axes, s.solid_inside);
    case SurfaceKind::kTorus:
      return make_torus(s.point, s.direction, s.radius, s.minor_radius, s.solid_inside);
    case SurfaceKind::kPolynomial:
      return make_polynomial(s.point, s.axes, s.terms, s.solid_inside, s.known_radius);
    case SurfaceKind::kPatch:
      break;
  }
  assert(false);
  return nullptr;
}

std::vector<FittedSurface> fit_surfaces(const Scene& scene,
                                        const OnProgress& on_patch,
                                        const MeshReader& read,
                                        int threads) {
  std::vector<PatchSource> sources = collect_sources(scene);
  std::vector<FittedSurface> surfaces(scene.surfaces.size());
  const MeshReader from_file = [](const MeshFile& file) { return load_mesh(file); };
  fit_sources(scene, read ? read : from_file, sources, surfaces, on_patch, threads);
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    if (scene.surfaces[i].kind != SurfaceKind::kPatch)
      surfaces[i].surface = make_exact_surface(scene.surfaces[i]);
  check_layers(scene, surfaces);
  return surfaces;
}

TriangleMesh load_body_mesh(const BodyDescription& body, std::vector<std::string>* told) {
  if (!body.mesh) return {};
  CleanMesh clean = clean_mesh(load_mesh(*body.mesh));
  if (clean.mesh.triangles.empty())
    throw InputError(fmt::format(
        "{}: no triangle of any area is left when vertices that coincide are merged, expected "
        "those of one bone",
        body.mesh->path.string()));
  if (told != nullptr)
    for (const std::string& line : describe(clean.report))
      told->push_back(of_body(body.name, line));
  return std::move(clean.mesh);
}

TriangleMesh body_mesh(const Scene& scene,
                       int body,
                       const std::vector<FittedSurface>& surfaces,
                       std::vector<std::string>* told) {
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    if (surfaces[i].bone && scene.surfaces[i].body == body) return *surfaces[i].bone;
  return load_body_mesh(scene.bodies[body], told);
}

std::vector<TriangleMesh> body_meshes(const Scene& scene,
                                      const std::vector<FittedSurface>& surfaces,
                                      std::vector<std::string>* told) {
  std::vector<TriangleMesh> meshes;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    meshes.push_back(body_mesh(scene, static_cast<int>(b), surfaces, told));
  return meshes;
}

}  // namespace condyle
