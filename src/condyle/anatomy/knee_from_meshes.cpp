#include "condyle/anatomy/knee_from_meshes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "condyle/anatomy/cartilage_doubts.h"
#include "condyle/anatomy/new_scene_text.h"
#include "condyle/anatomy/new_start.h"
#include "condyle/input_error.h"
#include "condyle/mesh/clean_mesh.h"
#include "condyle/mesh/main_parts.h"
#include "condyle/mesh_files/load_mesh.h"
#include "condyle/scene/ligament_path.h"
#include "condyle/scene/start_pose.h"
#include "condyle/scene_file/scene_words.h"
#include "condyle/specimen/fit_wraps.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kUnsure = 5;     // of an insertion, told as a doubt [mm]
constexpr double kDropped = 4;    // off the bone, likewise [mm]
constexpr double kOff = 5;        // beside the bone, likewise [mm]
constexpr double kPoorFit = 2.5;  // rms of the registered bones, likewise [mm]

/// Vertices that lie nearer to each other than rounding at the farthest one are merged: one that is far off leaves no
/// triangle.
[[noreturn]] void throw_no_triangles(const TriangleMesh& mesh) {
  std::vector<double> far;
  for (const Vector3d& v : mesh.vertices) far.push_back(v.norm());
  const auto middle = far.begin() + std::ssize(far) / 2;
  std::nth_element(far.begin(), middle, far.end());
  throw InputError(fmt::format(
      "no triangle is left when vertices that coincide are merged: half of them lie within {:.3g} "
      "of the origin, the farthest at {:.3g}, expected those of one bone",
      *middle, *std::max_element(middle, far.end())));
}

struct Loaded {
  KneeMeshes meshes;
  std::vector<Vector3d> tibial_centers;  // of each file with tibial cartilage
  std::vector<std::pair<std::filesystem::path, WeldedSeams>> seams;  // of files that had some
};

TriangleMesh cleaned(const std::filesystem::path& file, Loaded& loaded) {
  try {
    const TriangleMesh mesh = load_mesh_of_any_unit(file);
    CleanMesh clean = clean_mesh(mesh);
    if (clean.mesh.triangles.empty()) throw_no_triangles(mesh);
    if (clean.report.seams.length > 0) loaded.seams.emplace_back(file, clean.report.seams);
    return std::move(clean.mesh);
  } catch (const InputError& error) {
    const std::string text = error.what();
    if (text.find(file.string()) != std::string::npos) throw;
    throw InputError(file.string() + ": " + text);
  }
}

std::string describe(const MainParts& parts, double to_mm) {
  const bool one = parts.left_out == 1;
  const Vector3d size = to_mm * parts.size, at = to_mm * parts.middle;
  return fmt::format(
      "{} apart from the bone, {}{:.0f} by {:.0f} by {:.0f} mm about [{:.1f}, {:.1f}, {:.1f}] mm: "
      "its frame is told without {}",
      one ? "a piece" : fmt::format("{} pieces", parts.left_out), one ? "" : "the largest ",
      size.x(), size.y(), size.z(), at.x(), at.y(), at.z(), one ? "it" : "them");
}

void scale(TriangleMesh& mesh, double factor) {
  for (Vector3d& v : mesh.vertices) v *= factor;
}

Vector3d centroid(const TriangleMesh& mesh) {
  Vector3d sum = Vector3d::Zero();
  for (const Vector3d& v : mesh.vertices) sum += v;
  return sum / static_cast<double>(mesh.vertices.size());
}

Loaded load(const NewKneeFiles& files) {
  Loaded loaded;
  loaded.meshes.femur = cleaned(files.femur, loaded);
  loaded.meshes.tibia = cleaned(files.tibia, loaded);
  if (files.cartilage.empty()) return loaded;
  loaded.meshes.femoral_cartilage = cleaned(files.cartilage[0], loaded);
  TriangleMesh tibial;
  for (std::size_t i = 1; i < files.cartilage.size(); ++i) {
    const TriangleMesh part = cleaned(files.cartilage[i], loaded);
    loaded.tibial_centers.push_back(centroid(part));
    append(tibial, part);
  }
  loaded.meshes.tibial_cartilage = std::move(tibial);
  return loaded;
}

/// By the bones without what lies about them, which tells nothing of their frames.
RecognisedKnee recognise(const NewKneeFiles& files,
                         KneeMeshes meshes,
                         const RecogniseOptions& options) {
  MainParts femur = main_parts(meshes.femur), tibia = main_parts(meshes.tibia);
  meshes.femur = std::move(femur.mesh);
  meshes.tibia = std::move(tibia.mesh);
  try {
    RecognisedKnee knee = recognise_knee(meshes, options);
    for (const auto& [file, parts] : {std::pair(files.femur, femur), {files.tibia, tibia}})
      if (parts.left_out > 0)
        knee.doubts.push_back(file.string() + ": " + describe(parts, knee.to_mm));
    return knee;
  } catch (const InputError& error) {
    throw InputError(
        fmt::format("{} and {}: {}", files.femur.string(), files.tibia.string(), error.what()));
  }
}

/// Ends of the template's ligaments on one of its bones, and whose they are.
struct Insertions {
  std::vector<Vector3d> points;
  std::vector<std::pair<std::size_t, std::size_t>> owners;  // ligament of the new knee, end
};

Insertions insertions_on(const NewKnee& knee, int body) {
  Insertions found;
  for (std::size_t l = 0; l < knee.ligaments.size(); ++l) {
    const LigamentDescription& from =
        knee.model.scene.ligaments[static_cast<std::size_t>(knee.ligaments[l].of_template)];
    for (std::size_t end = 0; end < 2; ++end)
      if (from.ends[end].body == body) {
        found.points.push_back(from.ends[end].at);
        found.owners.emplace_back(l, end);
      }
  }
  return found;
}

CarriedPoints carry(
    NewKnee& knee, int body, const FramedBone& from, const FramedBone& to, bool femur) {
  const Insertions insertions = insertions_on(knee, body);
  CarriedPoints carried = carry_points(from, to, insertions.points);
  for (std::size_t i = 0; i < insertions.owners.size(); ++i) {
    const auto [ligament, end] = insertions.owners[i];
    knee.ligaments[ligament].ends[end] = carried.points[i];
    knee.ligaments[ligament].on_femur[end] = femur;
  }
  return carried;
}

/// Whether all that a ligament wraps on is fitted to bone, on sides that follow from it: then it can be fitted
/// to other bones.
bool on_bone(const Scene& scene, const LigamentDescription& ligament) {
  return ligament.path.sides.empty() &&
         std::all_of(ligament.path.wraps.begin(), ligament.path.wraps.end(), [&](int wrap) {
           return scene.wraps[static_cast<std::size_t>(wrap)].fit.has_value();
         });
}

/// What a template's scene asks for beside ligaments and loads.
void tell_what_is_left_out(NewKnee& knee) {
  const Scene& scene = knee.model.scene;
  for (const ConditionDescription& condition : scene.conditions)
    if (condition.kind != ConditionKind::kFlexion)
      knee.doubts.push_back(fmt::format(
          "condition \"{}\" of the template is left out: the scene prescribes flexion alone",
          condition.name));
}

/// Laws that know their slack length can be carried to bones of another size.
void choose_ligaments(NewKnee& knee) {
  const Scene& scene = knee.model.scene;
  const RigidTransform X_BA = start_pose(scene);
  int wrapped = 0;
  for (std::size_t l = 0; l < scene.ligaments.size(); ++l) {
    const LigamentDescription& ligament = scene.ligaments[l];
    if (!(slack_length(ligament.law) > 0)) {
      knee.doubts.push_back(fmt::format(
          "ligament \"{}\" of the template is left out: its law is given by absolute lengths",
          ligament.name));
      continue;
    }
    NewLigament chosen;
    chosen.of_template = static_cast<int>(l);
    chosen.on_bone = on_bone(scene, ligament);
    wrapped += chosen.on_bone ? 0 : 1;
    knee.wraps = knee.wraps || (chosen.on_bone && !ligament.path.wraps.empty());
    chosen.strain = ligament.reference_strain
                        ? *ligament.reference_strain
                        : ligament_length(scene, ligament, X_BA) / slack_length(ligament.law) - 1;
    knee.ligaments.push_back(chosen);
  }
  if (knee.ligaments.empty())
    throw InputError(knee.files.template_scene.string() +
                     ": as a template, expected a ligament that is toe-linear or quadratic");
  tell_what_is_left_out(knee);
  const auto layered = [](const ContactDescription& contact) { return contact.layer.has_value(); };
  if (std::any_of(scene.contacts.begin(), scene.contacts.end(), layered))
    knee.doubts.emplace_back(
        "the template's layers of cartilage are not carried over: contacts are rigid here");
  if (wrapped > 0)
    knee.doubts.push_back(fmt::format(
        "{} of the template's ligaments wrap on surfaces of its own; they are straight here, with "
        "the "
        "strain that they have wrapped (condyle check names those that run through bone)",
        wrapped));
}

/// Ends of ligaments to look at: "WHAT, 5 of 24: "aACL" femur ±6 mm, ..."; nothing where there are
/// none. `told`: what is said of one, empty of one that is as wanted.
void doubt_ends(NewKnee& knee,
                const std::string& what,
                const std::function<std::string(const CarriedPoint&)>& told) {
  constexpr int kNamed = 4;
  std::string names;
  int count = 0;
  for (const NewLigament& ligament : knee.ligaments)
    for (std::size_t end = 0; end < 2; ++end) {
      const std::string words = told(ligament.ends[end]);
      if (words.empty()) continue;
      const LigamentDescription& from =
          knee.model.scene.ligaments[static_cast<std::size_t>(ligament.of_template)];
      ++count;
      if (count <= kNamed)
        names += fmt::format("{}\"{}\" {} {}", names.empty() ? "" : ", ", from.name,
                             ligament.on_femur[end] ? "femur" : "tibia", words);
    }
  if (count > 0)
    knee.doubts.push_back(fmt::format("{}, {} of {}: {}{}", what, count, 2 * knee.ligaments.size(),
                                      names, count > kNamed ? ", ..." : ""));
}

void doubt_insertions(NewKnee& knee) {
  doubt_ends(knee, "insertions to look at", [](const CarriedPoint& point) {
    return point.uncertainty > kUnsure || point.dropped > kDropped
               ? fmt::format("±{:.0f} mm", point.uncertainty)
               : std::string();
  });
  doubt_ends(knee,
             "insertions farther from the bone than the template's, as beyond the end of a mesh "
             "that is cut short or on a "
             "fibula that is not in it",
             [](const CarriedPoint& point) {
               return point.farther > kOff ? fmt::format("by {:.0f} mm", point.farther)
                                           : std::string();
             });
  for (const auto& [carried, bone] : {std::pair{&knee.femur, "femur"}, {&knee.tibia, "tibia"}})
    if (carried->rms > kPoorFit)
      knee.doubts.push_back(
          fmt::format("the template's {} fits this one only to {:.1f} mm rms", bone, carried->rms));
}

/// Are there surfaces on these bones that the ligaments can wrap on? Else they are straight.
void try_wraps(NewKnee& knee, const KneeMeshes& meshes) {
  if (!knee.wraps) return;
  Scene scene = scene_of(knee);
  try {
    fit_wraps(scene, {meshes.femur, meshes.tibia});
  } catch (const InputError& error) {
    knee.wraps = false;
    knee.doubts.push_back("the template's wraps do not fit these bones, ligaments are straight: " +
                          without_file(error.what()));
  }
}

}  // namespace

NewKnee knee_from_meshes(const NewKneeFiles& files, const RecogniseOptions& options) {
  NewKnee knee;
  knee.files = files;
  Loaded loaded = load(files);
  knee.shape = recognise(files, loaded.meshes, options);
  if (unit_name(knee.shape.to_mm).empty())
    throw InputError(
        fmt::format("{}: its numbers look like inches, which scenes do not have: expected a mesh "
                    "in mm, cm or m",
                    files.femur.string()));
  knee.doubts = knee.shape.doubts;
  for (const auto& [file, seams] : loaded.seams)
    knee.doubts.push_back(file.string() + ": " + describe(seams, knee.shape.to_mm));
  scale(loaded.meshes.femur, knee.shape.to_mm);
  scale(loaded.meshes.tibia, knee.shape.to_mm);
  for (std::optional<TriangleMesh>* cartilage :
       {&loaded.meshes.femoral_cartilage, &loaded.meshes.tibial_cartilage})
    if (*cartilage) scale(**cartilage, knee.shape.to_mm);
  for (std::string& doubt : cartilage_doubts(loaded.meshes, knee.shape))
    knee.doubts.push_back(std::move(doubt));
  if (loaded.tibial_centers.size() == 2) {
    const Vector3d across = loaded.tibial_centers[1] - loaded.tibial_centers[0];
    knee.tibial_file =
        across.dot(knee.shape.tibia.frame.lateral) > 0 ? std::array{1, 2} : std::array{2, 1};
  }

  knee.model = load_template(files.template_scene);
  choose_ligaments(knee);
  const JointDescription& joint = *knee.model.scene.joint;
  knee.femur = carry(knee, joint.femur.body, {knee.model.femur, knee.model.shape.femur.frame},
                     {loaded.meshes.femur, knee.shape.femur.frame}, true);
  knee.tibia = carry(knee, joint.tibia.body, {knee.model.tibia, knee.model.shape.tibia.frame},
                     {loaded.meshes.tibia, knee.shape.tibia.frame}, false);
  doubt_insertions(knee);
  find_start(knee);
  try_wraps(knee, loaded.meshes);
  return knee;
}

}  // namespace condyle
