#pragma once

/// The measures of a phantom knee. Those that a struct has unless told otherwise are the shipped
/// phantom's; docs/phantom.md gives their sources. Lengths in mm, angles in rad.
///
/// Each bone is a shape of fixed formula that is sized along the axes: x and y by `depth`, z by
/// `width`. Measures are those before it is sized: sagittal radii come out times `depth`, coronal
/// ones times width²/depth.

#include "condyle/math/degree.h"

namespace condyle::phantom {

/// Factors on a bone's coordinates.
struct Size {
  double depth = 1;  ///< x and y
  double width = 1;  ///< z
};

/// A condyle: its sagittal outline is a J made of two arcs that touch at `turn`, the passage
/// rounded over `passage`; its coronal section is a circle.
struct Condyle {
  double z;          ///< of its middle, at x = 0
  double drift;      ///< dz/dx: condyles diverge backwards
  double posterior;  ///< radius of the posterior arc, centred at x = y = 0
  double distal;     ///< radius of the distal arc, greater
  double turn;       ///< where the arcs meet, measured from distal (-y) towards posterior (-x)
  double passage;
  double coronal;  ///< radius of the coronal section
  double wall;     ///< z of the outer wall
};

struct FemurParameters {
  Size size;
  Condyle medial{.z = -23.5,
                 .drift = 0.06,
                 .posterior = 21.5,
                 .distal = 34.0,
                 .turn = 28 * kDegree,
                 .passage = 8 * kDegree,
                 .coronal = 20,
                 .wall = -36.5};
  Condyle lateral{.z = 23.5,
                  .drift = -0.02,
                  .posterior = 20.0,
                  .distal = 36.0,
                  .turn = 18 * kDegree,
                  .passage = 8 * kDegree,
                  .coronal = 20,
                  .wall = 36.5};
};

/// Height of the tibial plateau: a dish of coronal and sagittal radius on a slope, per compartment.
struct Plateau {
  double x, z;      ///< its middle
  double height;    ///< y there
  double slope;     ///< rise per mm forwards: the posterior slope
  double sagittal;  ///< radius along x, positive concave, negative convex
  double coronal;   ///< radius along z, positive concave
};

struct TibiaParameters {
  Size size;
  double rise = 0;  ///< of the sized bone along y: closes the medial compartment
  Plateau medial{
      .x = 2.0, .z = -23.5, .height = -24.17, .slope = 0.1228, .sagittal = 90, .coronal = 28};
  Plateau lateral{
      .x = 1.0, .z = 23.5, .height = -21.05, .slope = 0.1051, .sagittal = -45, .coronal = 60};
};

struct PhantomParameters {
  FemurParameters femur;
  TibiaParameters tibia;
};

/// The shipped phantom.
inline constexpr PhantomParameters kShippedPhantom{};

}  // namespace condyle::phantom
