#pragma once

/// The model of [Wismans 1980] as far as it is known: springs, loads, two contacts that are always
/// closed, and a prescribed flexion. Plain data; constant while poses are solved, but for the
/// flexion and the factors on loads.

#include <array>
#include <string>
#include <vector>

#include "condyle/elements/body_origins.h"
#include "condyle/elements/joint_coordinates.h"
#include "condyle/elements/line_element.h"
#include "condyle/elements/load.h"
#include "condyle/reference/height_surface.h"

namespace condyle {

struct WismansContact {
  std::string name;
  HeightSurface on_B, on_A;
  std::size_t index = 0;  ///< among the contacts of the scene
};

struct WismansModel {
  std::vector<LineElement> springs;
  std::vector<Load> loads;  ///< no custom ones
  std::array<WismansContact, 2> contacts;
  std::size_t scene_contacts = 2;  ///< those that are held open too
  JointFrames joint;
  double flexion = 0;    ///< prescribed [rad]
  RigidTransform start;  ///< in the frames of files, as poses that are told
  BodyOrigins origins;   ///< of the frames of all the rest: points in the joint
  double length = 30;    ///< [mm]: makes angles and lengths, moments and forces comparable
};

/// The 16 unknowns, in this order: a (3) [mm], adduction, internal rotation [rad]; of each contact
/// (x, y) on B and (x, y) on A [mm]; contact forces [N]; flexion moment [N mm].
inline constexpr int kWismansUnknowns = 16;
using WismansVector = Eigen::Matrix<double, kWismansUnknowns, 1>;
using WismansMatrix = Eigen::Matrix<double, kWismansUnknowns, kWismansUnknowns>;

namespace wismans {
inline constexpr int kTranslation = 0, kAdduction = 3, kInternalRotation = 4, kForce = 13,
                     kMoment = 15;
constexpr int on_B(int contact) { return 5 + 4 * contact; }
constexpr int on_A(int contact) { return 7 + 4 * contact; }
}  // namespace wismans

}  // namespace condyle
