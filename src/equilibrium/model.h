#pragma once

/// The scene as the solver wants it: every point on the body that carries it, bodies reduced to B
/// (fixed, ground frame) and A (moving). Constant, and shared by as many solvers as there are
/// threads: what changes from pose to pose is an argument (drive.h), for which the values of its
/// conditions and the scales of its loads are the nominal numbers. Its frames have their origins in the joint; poses that are told are in the files' frames.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "elements/body_origins.h"
#include "elements/hertz.h"
#include "elements/joint_coordinates.h"
#include "elements/kinematic_condition.h"
#include "elements/line_element.h"
#include "elements/load.h"
#include "surface/surface.h"

namespace condyle {

/// Whether a contact opens and closes by itself, is held closed (it may pull), or is left out.
enum class ContactMode { kAuto, kClosed, kOpen };

struct ContactPair {
  std::string name;
  std::shared_ptr<const Surface> on_B, on_A;
  std::string surface_B, surface_A;  ///< their names
  ContactMode mode = ContactMode::kAuto;
  std::vector<Eigen::Vector3d> start;  ///< first estimates of contact points, ground frame [mm]
  std::optional<ElasticSurface> elastic_B, elastic_A;  ///< absent: rigid
};

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

/// Most contacts plus conditions at once: with six the pose is a mechanism and the loads follow
/// [Dortmans 1986 stops at five].
inline constexpr int kMaxConstraints = 6;

/// What makes a condition a length: L for an angle, 1 for a length.
[[nodiscard]] double condition_weight(const Model& model, std::size_t condition);

/// The smaller of a contact's distances from the edges of its two surfaces [mm].
[[nodiscard]] double edge_distance(const ContactPair& pair, const Place& on_B, const Place& on_A);

/// Root mean square lever arm of A's insertions and contact surfaces about the middle of these
/// surfaces (model_origins.h): the same wherever the frames have their origins. A surface counts
/// with its extent, or that of the smaller one it meets. Where there is but one point: that of
/// points of loads, else the mean length of the line elements at the start, else 1 mm.
[[nodiscard]] double characteristic_length(const Model& model);

}  // namespace condyle
