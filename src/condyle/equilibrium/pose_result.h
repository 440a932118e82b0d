#pragma once

/// What the equilibrium solver says about one pose, and a sweep about all: plain data for results
/// and pictures. Units inside: mm, N, N mm, rad. B is the fixed body (ground frame), A the moving
/// one.

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "condyle/contact/contact_result.h"
#include "condyle/contact/pose_status.h"
#include "condyle/elements/body_origins.h"
#include "condyle/elements/joint_coordinates.h"
#include "condyle/elements/line_path.h"
#include "condyle/equilibrium/pose_trace.h"
#include "condyle/math/no_number.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

struct LineElement;

struct LigamentResult {
  double length = 0, strain = 0,
         force = 0;  ///< [mm], [-] (0 where the law has no slack length), [N]
};

/// How a ligament goes from its end on the fixed body to that on the moving one.
struct LigamentPath {
  std::vector<Eigen::Vector3d> points;  ///< corners between the ends, ground frame [mm]
  std::vector<LineTouch> touches;       ///< one for each surface that it wraps on
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
  std::vector<LigamentPath> paths;          ///< as in Scene::ligaments; none where all are straight
  int stability = -1;                       ///< 1 stable, 0 neutral or unstable, -1 not computed
  double lowest_stiffness = kNoNumber;      ///< of the reduced stiffness [N/mm]
  std::optional<JointStiffness> joint_stiffness;  ///< on request; needs joint frames
  int iterations = 0;                             ///< Newton iterations
  double residual = 0;  ///< largest out-of-balance force [N], moments divided by the model's length
  PoseTrace trace;      ///< by which way it was found
  double seconds = 0;   ///< spent on the pose
  double event_seconds = 0;  ///< spent on the events between the solved pose before it and this one
  [[nodiscard]] bool converged() const { return status == PoseStatus::kConverged; }
  /// In equilibrium, with all its numbers: converged, or with a contact beyond its patch.
  [[nodiscard]] bool solved() const;
};

/// An empty result that keeps the memory of the one before.
void clear(PoseResult& result);

/// What whoever solved a pose knows of it, in the frames that it computes in.
struct PoseFacts {
  const RigidTransform& X_BA;
  const JointFrames* joint;  ///< null: no joint coordinates
  const std::vector<LineElement>& elements;
  const std::vector<double>& paths;  ///< numbers that the elements' paths keep, or none
  std::size_t contacts;              ///< how many pairs there are
};

/// The one way in which a solved pose is told, be it of statics, of a motion, of Wismans' model or
/// of a comparison. To an empty result: X_BA, joint coordinates, line elements with the forces of
/// their laws, contacts of which nothing is known yet. Conditions and points of contact follow.
void begin_pose(const PoseFacts& facts, PoseResult& result);

/// One more point that carries; the contact's force and resultant are those of all its points.
void add_closed_point(const ContactPointResult& point, ContactResult& contact);

/// The nearest point of a contact that is open.
void set_nearest_point(const ContactPointResult& point, ContactResult& contact);

/// Are all numbers told of pose, joint, contacts, ligaments and conditions finite? A contact that is not closed
/// may have no place.
[[nodiscard]] bool has_finite_numbers(const PoseResult& pose);

/// At last, from the frames of a model to those of the files: X_BA and all points.
void to_file_frames(const BodyOrigins& origins, PoseResult& pose);

/// What happens to a contact or a ligament at one value of a sweep; the values are those of /events/kind.
enum class EventKind {
  kClosing = 0,           ///< a point of contact begins to carry
  kOpening = 1,           ///< a point of contact ceases to carry
  kJump = 2,              ///< the contact goes from one place to another
  kLeavingPatch = 3,      ///< the contact passes the edge of the known surface outwards
  kReturningToPatch = 4,  ///< and inwards
  kLimitPoint = 5,        ///< the path of equilibria turns back: the joint snaps through
  kTouching = 6,          ///< a ligament comes to lie on a surface that it wraps on
  kLifting = 7            ///< and leaves it
};
inline constexpr int kEventKindCount = 8;

/// "closing", "opening", "jump", ...
[[nodiscard]] const char* name(EventKind kind);

struct Event {
  double value = 0;  ///< of what is swept [rad], [mm] or [-]
  EventKind kind = EventKind::kClosing;
  int contact = 0;    ///< index into Scene::contacts; -1 where no contact is meant
  int ligament = -1;  ///< index into Scene::ligaments, and
  int wrap = -1;      ///< of the surface among those of its path, from the fixed body on
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
