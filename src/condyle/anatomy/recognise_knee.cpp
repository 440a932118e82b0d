#include "condyle/anatomy/recognise_knee.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "condyle/anatomy/femoral_frame.h"
#include "condyle/anatomy/knee_ends.h"
#include "condyle/anatomy/knee_faults.h"
#include "condyle/anatomy/knee_side.h"
#include "condyle/anatomy/tibial_frame.h"
#include "condyle/input_error.h"
#include "condyle/math/degree.h"
#include "condyle/scene_file/scene_words.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

constexpr double kLeastConfidence = 0.8;
// Features of one bone go together: all of them say half of what they would say if independent.
constexpr double kIndependence = 0.5;

/// x -> (x - shift) * scale.
void move(TriangleMesh& mesh, const Vector3d& shift, double scale) {
  for (Vector3d& p : mesh.vertices) p = (p - shift) * scale;
}

void scale_ends(KneeEnds& ends, double scale) {
  ends.joint *= scale;
  ends.femur_width *= scale;
  ends.tibia_width *= scale;
  ends.gap *= scale;
}

/// Logarithm of the odds for a right knee.
double log_odds(const std::vector<SideEvidence>& evidence) {
  double sum = 0;
  for (const SideEvidence& e : evidence) sum += kIndependence * e.log_ratio;
  return sum;
}

/// What speaks for a side, and how much.
std::string in_words(const std::vector<SideEvidence>& evidence, Side side) {
  const double sign = side == Side::kRight ? 1 : -1;
  std::string words;
  for (const SideEvidence& e : evidence)
    words += fmt::format("{}{} {:.1f} {} ({:+.1f})", words.empty() ? "" : ", ", e.feature,
                         sign * e.value, e.unit, sign * kIndependence * e.log_ratio);
  return words;
}

const char* name_of(Side side) { return side == Side::kRight ? "right" : "left"; }

/// Two bones that each are sure of another side are no knee.
void check_agreement(double femur, double tibia) {
  constexpr double kSure = 1.5;
  if (std::min(std::abs(femur), std::abs(tibia)) < kSure || femur * tibia > 0) return;
  throw InputError(
      fmt::format("the femur is that of a {} knee and the tibia that of a {} one, or one of them "
                  "is turned back to front; if not so, say it by --side left or --side right",
                  femur > 0 ? "right" : "left", tibia > 0 ? "right" : "left"));
}

void tell_side(RecognisedKnee& knee,
               const std::vector<SideEvidence>& femur,
               const std::vector<SideEvidence>& tibia,
               const RecogniseOptions& options) {
  const double of_femur = log_odds(femur), of_tibia = log_odds(tibia);
  if (!options.side) check_agreement(of_femur, of_tibia);
  const double odds = of_femur + of_tibia;
  const Side seen = odds >= 0 ? Side::kRight : Side::kLeft;
  knee.side = options.side.value_or(seen);
  knee.side_confidence = 1 / (1 + std::exp(knee.side == seen ? -std::abs(odds) : std::abs(odds)));
  knee.side_evidence = in_words(femur, knee.side) + ", " + in_words(tibia, knee.side);
  if (!options.side && knee.side_confidence < kLeastConfidence)
    throw InputError(
        fmt::format("left or right cannot be told from the shape: {} with a probability of {:.2f}; "
                    "say it by --side left or --side right",
                    name_of(seen), knee.side_confidence));
  if (knee.side_confidence < 0.2)
    knee.doubts.push_back(
        fmt::format("by its shape a {} knee, with a probability of {:.2f}: if --side {} is wrong, "
                    "medial and lateral are interchanged in all that follows",
                    name_of(seen), 1 - knee.side_confidence, name_of(knee.side)));
  else if (knee.side_confidence < 0.95)
    knee.doubts.push_back(fmt::format("{} knee with a probability of {:.2f} only",
                                      name_of(knee.side), knee.side_confidence));
}

BoneFrame in_file_frame(BoneFrame frame, const Vector3d& origin, Side side) {
  frame.origin = origin;
  if (side == Side::kLeft) frame.lateral *= -1;
  return frame;
}

std::string femoral_rule(const FemoralShape& f) {
  const std::string axis = fmt::format(
      "lateral: axis of one cylinder through both posterior condyles [Miranda 2010], radius {:.1f} "
      "mm, {:.2f} mm rms; ",
      f.cylinder.radius, f.cylinder.rms);
  const std::string proximal =
      f.shaft > 0
          ? fmt::format("proximal: centroids of the shaft's sections {:.0f} to {:.0f} mm above it",
                        f.shaft_first, f.shaft_first + f.shaft)
          : std::string(
                "proximal: between what the outline of the trochlea and the tibia as scanned say");
  return axis + proximal + "; origin: on the axis, midway between the condyles";
}

std::string tibial_rule(const TibialShape& t) {
  const std::string proximal =
      t.shaft > 0 ? fmt::format(
                        "proximal: centroids of the shaft's sections {:.0f} to {:.0f} mm below the "
                        "plateau [Grood and Suntay 1983]",
                        t.shaft_first, t.shaft_first + t.shaft)
                  : fmt::format("proximal: plane of the plateau, falling {:.1f} degrees backwards",
                                t.slope / kDegree);
  return "lateral: line through the middles of both plateaus; " + proximal +
         "; origin: that of the femur as scanned";
}

void doubt_pose(RecognisedKnee& knee, const KneeEnds& ends) {
  const Vector3d k = knee.femur.frame.components(knee.tibia.frame.proximal);
  const double flexion = std::atan2(k.x(), k.y()) / kDegree;
  if (std::abs(flexion) > 8)
    knee.doubts.push_back(fmt::format("scanned {:.0f} degrees {}, as the frames see it",
                                      std::abs(flexion),
                                      flexion > 0 ? "flexed" : "beyond extension"));
  const double adduction = std::asin(std::clamp(k.z(), -1.0, 1.0)) / kDegree;
  if (std::abs(adduction) > 7)
    knee.doubts.push_back(fmt::format("the tibia is {} by {:.0f} degrees in the scan",
                                      adduction > 0 ? "adducted" : "abducted",
                                      std::abs(adduction)));
  const Vector3d j = knee.femur.frame.components(knee.tibia.frame.anterior);
  const double turn = std::atan2(-j.z(), j.x()) / kDegree;
  if (std::abs(turn) > 12)
    knee.doubts.push_back(fmt::format("the tibia is turned {} by {:.0f} degrees in the scan",
                                      turn > 0 ? "inwards" : "outwards", std::abs(turn)));
  if (ends.gap > 10) knee.doubts.push_back(fmt::format("the bones are {:.0f} mm apart", ends.gap));
}

void doubt_shafts(RecognisedKnee& knee) {
  if (knee.femur.shaft == 0)
    knee.doubts.emplace_back(
        "too little of the femur's shaft for its direction: flexion of its frame is good to about "
        "6 degrees");
  if (knee.tibia.shaft == 0)
    knee.doubts.emplace_back(
        "too little of the tibia's shaft for its direction: flexion of its frame is good to about "
        "3 degrees");
}

std::string unit_in_words(double to_mm, bool said) {
  const std::string unit = unit_name(to_mm);
  const std::string name = unit.empty() ? "inches" : unit;
  return said ? "in " + name + ", as --units says"
              : "taken to be in " + name + "; --units names another";
}

}  // namespace

std::string side_in_words(const RecognisedKnee& knee) {
  const double sure = 100 * knee.side_confidence;
  const Side other = knee.side == Side::kRight ? Side::kLeft : Side::kRight;
  return sure < 50 ? fmt::format("{}, as --side says; {} by its shape, {:.1f} % sure",
                                 name_of(knee.side), name_of(other), 100 - sure)
                   : fmt::format("{}, {:.1f} % sure", name_of(knee.side), sure);
}

RecognisedKnee recognise_knee(const KneeMeshes& meshes, const RecogniseOptions& options) {
  check_meshes(meshes);
  TriangleMesh femur_mesh = meshes.femur, tibia_mesh = meshes.tibia;
  const Vector3d shift = surface_extents(tibia_mesh).middle;
  move(femur_mesh, shift, 1);
  move(tibia_mesh, shift, 1);
  KneeEnds ends = find_knee_ends(femur_mesh, tibia_mesh);

  RecognisedKnee knee;
  knee.to_mm = tell_unit(ends, options.to_mm);
  move(femur_mesh, Vector3d::Zero(), knee.to_mm);
  move(tibia_mesh, Vector3d::Zero(), knee.to_mm);
  scale_ends(ends, knee.to_mm);

  CleanMesh femur_clean = clean_mesh(std::move(femur_mesh)),
            tibia_clean = clean_mesh(std::move(tibia_mesh));
  const Condyles condyles = find_condyles_or_say_why(femur_clean, tibia_clean, ends);
  const TibialShape tibia = find_tibia_or_say_why(tibia_clean, ends, condyles);
  const FemoralShape femur =
      find_femoral_frame(femur_clean.mesh, condyles, ends, tibia.frame.proximal);
  check_shafts(femur_clean, femur, tibia_clean, tibia);
  check_they_fit(femur, tibia, ends, unit_in_words(knee.to_mm, options.to_mm.has_value()));

  tell_side(knee, weigh_femur(femur), weigh_tibia(tibia, tibia_clean.mesh), options);
  const Vector3d origin = shift * knee.to_mm + femur.frame.origin;
  knee.femur = {in_file_frame(femur.frame, origin, knee.side), femoral_rule(femur), femur.width,
                femur.shaft};
  knee.tibia = {in_file_frame(tibia.frame, origin, knee.side), tibial_rule(tibia),
                tibia.plateau.width, tibia.shaft};
  if (meshes.femoral_cartilage)
    check_both_sides(*meshes.femoral_cartilage, knee.to_mm, knee.femur.frame, femur.width,
                     "femoral");
  if (meshes.tibial_cartilage)
    check_both_sides(*meshes.tibial_cartilage, knee.to_mm, knee.tibia.frame, tibia.plateau.width,
                     "tibial");
  doubt_shafts(knee);
  doubt_pose(knee, ends);
  return knee;
}

}  // namespace condyle
