#pragma once

/// The scene as the solver wants it: every point on the body that carries it, bodies reduced to B
/// (fixed, ground frame) and A (moving). Constant, and shared by as many solvers as there are
/// threads: what changes from pose to pose is an argument (drive.h), for which the values of its
/// conditions and the scales of its loads are the nominal numbers. Its frames have their origins in the joint; poses that are told are in the files' frames.

#include <optional>
#include <string>
#include <vector>

#include "condyle/contact/contact_pair.h"
#include "condyle/contact/contact_scales.h"
#include "condyle/elements/body_origins.h"
#include "condyle/elements/joint_coordinates.h"
#include "condyle/elements/kinematic_condition.h"
#include "condyle/elements/line_element.h"
#include "condyle/elements/load.h"

namespace condyle {

struct Model {
  std::vector<LineElement> elements;
  std::vector<std::string> element_names;
  std::vector<KinematicCondition> conditions;
  std::vector<std::string> condition_names;
  std::vector<Load> loads;
  std::vector<std::string> load_names;
  std::vector<ContactPair> pairs;
  std::optional<JointFrames> joint;
  RigidTransform start;  ///< first estimate of X_BA
  BodyOrigins origins;   ///< of the frames of all the above, in the frames of results and files
  double length =
      30;  ///< L [mm]: lever arms of the model; makes rotations L dπ and moments m/L comparable
};

/// What makes a condition a length: L for an angle, 1 for a length.
[[nodiscard]] double condition_weight(const Model& model, std::size_t condition);

/// Root mean square lever arm of A's insertions and contact surfaces about the middle of these
/// surfaces (model_origins.h): the same wherever the frames have their origins. A surface counts
/// with its extent, or that of the smaller one it meets. Where there is but one point: that of
/// points of loads, else the mean length of the line elements at the start, else 1 mm.
[[nodiscard]] double characteristic_length(const Model& model);

}  // namespace condyle
