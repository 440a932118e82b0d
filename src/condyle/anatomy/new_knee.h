#pragma once

/// A knee made of two meshes, before it is written as a scene: plain data.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "condyle/anatomy/carry_points.h"
#include "condyle/anatomy/recognise_knee.h"
#include "condyle/anatomy/template_knee.h"
#include "condyle/elements/joint_coordinates.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

struct NewKneeFiles {
  std::filesystem::path femur, tibia;
  std::vector<std::filesystem::path>
      cartilage;  ///< none; femoral and tibial; or femoral and two tibial ones
  std::filesystem::path template_scene;
};

/// A ligament of the template on the new bones.
struct NewLigament {
  int of_template = -1;               ///< index into the template's ligaments
  std::array<CarriedPoint, 2> ends;   ///< in the order of the template's
  std::array<bool, 2> on_femur = {};  ///< which bone each is on
  bool on_bone = false;  ///< all that it wraps on, if anything, is fitted to the template's
                         ///< bones: it can be fitted to others
  double strain = 0;     ///< at the start pose, the template's and this one's [-]
};

/// How the start pose came about.
struct NewStart {
  RigidTransform X_FT;              ///< of the tibia in the femur's frame; identity: as scanned
  JointCoordinates scan;            ///< of the scan, in the new frames
  double extended = 0;              ///< flexion taken away, to that of the template [rad]
  double shifted = 0;               ///< along the tibia, towards the femur positive [mm]
  double tilted = 0;                ///< adduction added so that both compartments touch [rad]
  std::array<double, 2> gaps = {};  ///< medial and lateral, before [mm], negative: overlap
  std::array<double, 4> offset =
      {};  ///< in place of cartilage: medial condyle and plateau, lateral
           ///< condyle and plateau [mm]
};

struct NewKnee {
  NewKneeFiles files;
  RecognisedKnee shape;
  TemplateKnee model;  ///< the template
  CarriedPoints femur, tibia;
  std::vector<NewLigament> ligaments;
  bool wraps = false;  ///< ligaments lie on the bone as those of the template do (fit = "bone")
  NewStart start;
  std::array<int, 2> tibial_file = {1, 1};  ///< of files.cartilage, medial and lateral
  std::vector<std::string> doubts;          ///< what a person should look at, one line each
};

}  // namespace condyle
