#pragma once

/// What the equilibrium solver says about one pose, and a sweep about all: plain data for results
/// and pictures. Units inside: mm, N, N mm, rad. B is the fixed body (ground frame), A the moving
/// one.

#include <Eigen/Core>

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "condyle/elements/body_origins.h"
#include "condyle/elements/joint_coordinates.h"
#include "condyle/equilibrium/pose_trace.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

/// The values are those of /sweep/status.
enum class PoseStatus {
  kConverged = 0,
  kIterationLimit = 1,  ///< the iteration did not settle
  kDiverged = 2,        ///< the pose ran away or a number overflowed
  kSingular = 3,   ///< dependent conditions or contacts, or a motion that nothing resists (named in
                   ///< `reason`)
  kLeftPatch = 4,  ///< a closed contact lies beyond the known part of its surface: an equilibrium
                   ///< on the surface as it is extrapolated there
  kNoEquilibrium = 5,  ///< a load that nothing carries
  kZeroLength = 6,     ///< a line element of zero length
  kOverlap = 7,  ///< the surfaces overlap elsewhere and no admissible set of contacts was found
  kNotComputed = 8
};
inline constexpr int kPoseStatusCount = 9;

/// A short name: "converged", "iteration limit", ...
[[nodiscard]] const char* name(PoseStatus status);

/// How a rigid contact would spread over an elastic surface, estimated afterwards
/// (contact/hertz.h).
struct HertzEstimate {
  std::array<double, 2> semi_axes;  ///< of the ellipse of contact, major first [mm]
  Eigen::Vector3d major_axis;       ///< unit vector, ground frame
  double peak_pressure;             ///< [N/mm²]
  double approach;                  ///< of the two bodies [mm]
};

/// One point of contact.
struct ContactPointResult {
  double force = 0;               ///< p [N], > 0 pushes apart
  Eigen::Vector3d point_ground;   ///< [mm]
  Eigen::Vector3d point_moving;   ///< the same point in A's frame [mm]
  Eigen::Vector3d normal_ground;  ///< unit, out of the fixed body's solid
  double gap = 0;                 ///< [mm]
  std::array<double, 2>
      relative_curvature;  ///< principal values of -(K + Kr) [1/mm], ascending; > 0 isolated
  double edge_distance =
      std::numeric_limits<double>::infinity();  ///< to the edge of the known surfaces [mm]
  bool on_edge = false;                         ///< within the margin of a patch's known region
  std::optional<HertzEstimate> hertz;           ///< where the surfaces have a modulus
};

/// What kind of place two surfaces touch in; the values are those of /sweep/contacts/NAME/shape.
enum class ContactShape {
  kPoint = 0,      ///< isolated points
  kLine = 1,       ///< along a straight line, carried by its two ends
  kConforming = 2  ///< over an area: rigid surfaces do not say where
};

/// A pair of surfaces. Closed with one or more points; open, it tells where the gap is smallest.
struct ContactResult {
  bool closed = false;
  ContactShape shape = ContactShape::kPoint;
  double force = 0;  ///< sum over the points [N]
  /// Where the resultant of the points acts, ground frame [mm]; of an open contact the nearest
  /// point.
  Eigen::Vector3d resultant_ground =
      Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  std::vector<ContactPointResult>
      points;  ///< closed: those that carry; open: the nearest one, force 0
};

struct LigamentResult {
  double length = 0, strain = 0,
         force = 0;  ///< [mm], [-] (0 where the law has no slack length), [N]
};

struct ConditionResult {
  double value = 0;       ///< [rad] or [mm]
  double multiplier = 0;  ///< σ: [N mm] for angles, [N] for lengths; its load on A is -σ dk
};

/// Of the joint at a pose, in joint coordinates (flexion, adduction, internal rotation, lateral
/// shift, anterior drawer, distraction; mm, N, rad): what an added load Q, conjugate to the
/// coordinates, does.
struct JointStiffness {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  Matrix6 stiffness;  ///< ∂Q/∂q of ligaments, loads and rolling contacts before the constraints
  Matrix6 compliance;  ///< ∂q/∂Q with contacts kept closed and conditions prescribed
};

struct PoseResult {
  double value = 0;  ///< of what is swept [rad], [mm] or [-]
  PoseStatus status = PoseStatus::kNotComputed;
  std::string reason;  ///< one line where the status is not converged
  std::string remark;  ///< one line on a converged pose that a reader should know: what motion is
                       ///< free, a contact that is a line ...; mostly empty
  RigidTransform X_BA;
  JointCoordinates joint;
  std::vector<ContactResult> contacts;      ///< as in Scene::contacts
  std::vector<LigamentResult> ligaments;    ///< as in Scene::ligaments
  std::vector<ConditionResult> conditions;  ///< as in Scene::conditions
  int stability = -1;                       ///< 1 stable, 0 neutral or unstable, -1 not computed
  double lowest_stiffness =
      std::numeric_limits<double>::quiet_NaN();  ///< of the reduced stiffness [N/mm]
  Eigen::Matrix<double, 6, 1> softest_motion =
      Eigen::Matrix<double, 6, 1>::Zero();  ///< (da, L dπ) that belongs to it, unit; da of the
                                            ///< point of A that the model is computed about
  std::optional<JointStiffness> joint_stiffness;  ///< on request; needs joint frames
  int iterations = 0;                             ///< Newton iterations
  double residual = 0;  ///< largest out-of-balance force [N], moments divided by the model's length
  PoseTrace trace;      ///< by which way it was found
  double seconds = 0;   ///< spent on the pose
  double event_seconds = 0;  ///< spent on the events between the solved pose before it and this one
  [[nodiscard]] bool converged() const { return status == PoseStatus::kConverged; }
  /// In equilibrium, with all its numbers: converged, or with a contact beyond its patch.
  [[nodiscard]] bool solved() const {
    return (converged() || status == PoseStatus::kLeftPatch) && X_BA.p.allFinite();
  }
};

/// A pose as a model tells it, from its frames to those of the files: X_BA and all points.
void to_file_frames(const BodyOrigins& origins, PoseResult& pose);

/// What happens to a contact at one value of a sweep; the values are those of /events/kind.
enum class EventKind {
  kClosing = 0,           ///< a point of contact begins to carry
  kOpening = 1,           ///< a point of contact ceases to carry
  kJump = 2,              ///< the contact goes from one place to another
  kLeavingPatch = 3,      ///< the contact passes the edge of the known surface outwards
  kReturningToPatch = 4,  ///< and inwards
  kLimitPoint = 5         ///< the path of equilibria turns back: the joint snaps through
};
inline constexpr int kEventKindCount = 6;

/// "closing", "opening", "jump", ...
[[nodiscard]] const char* name(EventKind kind);

struct Event {
  double value = 0;  ///< of what is swept [rad], [mm] or [-]
  EventKind kind = EventKind::kClosing;
  int contact = 0;  ///< index into Scene::contacts; -1 where no contact is meant
};

struct SweepResult {
  std::vector<PoseResult> poses;
  std::vector<Event> events;  ///< in the order in which the sweep meets them
  [[nodiscard]] int count_converged() const {
    int n = 0;
    for (const PoseResult& pose : poses) n += pose.converged() ? 1 : 0;
    return n;
  }
};

}  // namespace condyle
