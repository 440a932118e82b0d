#pragma once

/// The described knee: plain data, what a scene file says, in the units used inside (mm, N, N mm,
/// rad, tonne).
///
/// Indices refer to the vectors of the same Scene. A scene refers to meshes by path; nothing is
/// loaded here.

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "condyle/contact/hertz.h"
#include "condyle/contact/layer_options.h"
#include "condyle/elements/force_law.h"
#include "condyle/elements/kinematic_condition.h"
#include "condyle/math/rigid_transform.h"
#include "condyle/scene/bone_fit.h"
#include "condyle/scene/calibration_description.h"
#include "condyle/scene/parameter_kind.h"
#include "condyle/scene/sweep_range.h"
#include "condyle/surface/exact_surfaces.h"
#include "condyle/wrapping/wrap_shape.h"

namespace condyle {

struct MeshFile {
  std::filesystem::path path;  ///< as it can be opened: already joined with the folder of the scene
  double to_mm = 1;            ///< factor from the file's unit to mm
  std::string named_at;        ///< file, line, table and key of the scene, for messages

  /// Whether both stand for one mesh, wherever they are named.
  [[nodiscard]] bool is(const MeshFile& other) const {
    return path == other.path && to_mm == other.to_mm;
  }
};

struct BodyDescription {
  std::string name;
  bool fixed = false;
  std::optional<MeshFile> mesh;
  /// Start pose of a moving body in the ground frame, a first estimate. Joint angles, where given,
  /// stand in for the rotation (they need [joint]).
  Eigen::Vector3d start_translation = Eigen::Vector3d::Zero();  ///< of O_A [mm]
  Eigen::Vector3d start_rotation = Eigen::Vector3d::Zero();     ///< rotation vector [rad]
  std::optional<std::array<double, 3>>
      start_joint_angles;  ///< flexion, adduction, internal rotation [rad]
  /// Mass data, read only by `simulate`.
  std::optional<double> density;           ///< [tonne/mm³]
  std::optional<double> mass;              ///< [tonne]
  std::optional<Eigen::Vector3d> center;   ///< of mass, body frame [mm]
  std::optional<Eigen::Matrix3d> inertia;  ///< about the mass centre, body frame [tonne mm²]
};

enum class Side { kRight, kLeft };

/// An anatomical frame fixed to a body. `lateral` points away from the body's midplane on either
/// side, so the triad (lateral, anterior, proximal) is right-handed for a right knee and
/// left-handed for a left one.
struct AnatomicalFrame {
  int body = -1;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [mm], body frame
  Eigen::Vector3d lateral, anterior, proximal;       ///< unit vectors, body frame
};

struct JointDescription {
  Side side = Side::kRight;
  AnatomicalFrame femur, tibia;
};

enum class SurfaceKind { kPatch, kPlane, kSphere, kCylinder, kEllipsoid, kTorus, kPolynomial };
enum class Compartment { kMedial, kLateral };

/// Which part of a mesh a patch covers, and how it is fitted.
struct PatchDescription {
  std::optional<Compartment> compartment;  ///< absent: all that a box holds
  std::optional<std::array<Eigen::Vector3d, 2>>
      region_box;  ///< two opposite corners, body frame [mm]; nothing outside belongs to the patch
  std::optional<std::array<double, 2>>
      region_angles;  ///< first and last of a condyle about its axis, 0 distal, + posterior [rad]
  std::optional<double> region_least_cosine;  ///< of the normal and the direction that is faced
  double offset =
      0;  ///< the fitted surface is moved this far along its normal, out of the bone [mm]
  std::optional<MeshFile> mesh;                      ///< of its own, in place of the body's
  std::optional<std::array<int, 2>> control_points;  ///< absent: chosen from the data
  std::optional<double> smoothing;   ///< smoothing length [mm]; absent: chosen from the data
  bool smooth_for_position = false;  ///< chosen for the least error of position, not of normals
  int degree = 3;
};

struct SurfaceDescription {
  std::string name;
  int line = 0;  ///< where its table stands in the file, for messages
  int body = -1;
  SurfaceKind kind = SurfaceKind::kPatch;
  bool solid_inside = true;  ///< closed kinds: the solid is within (a ball) or around (a socket)
  PatchDescription patch;    ///< kPatch

  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< plane: a point; cylinder: on the axis;
                                                    ///< sphere, ellipsoid, torus: the centre [mm]
  Eigen::Vector3d direction =
      Eigen::Vector3d::UnitZ();  ///< plane: normal out of the solid; cylinder, torus: axis; unit
  double radius = 0;             ///< sphere, cylinder, torus: major radius [mm]
  double minor_radius = 0;       ///< torus [mm]
  double length =
      std::numeric_limits<double>::infinity();  ///< cylinder, half to either side of `point` [mm]
  double known_radius =
      std::numeric_limits<double>::infinity();  ///< plane, polynomial: of the part that is known,
                                                ///< about `point` [mm]
  Eigen::Vector3d semi_axes = Eigen::Vector3d::Ones();  ///< ellipsoid [mm]
  Eigen::Matrix3d axes =
      Eigen::Matrix3d::Identity();    ///< ellipsoid: columns are the axes; polynomial: x, y, height
  std::vector<PolynomialTerm> terms;  ///< polynomial: height over the plane through `point`
  std::optional<ElasticSurface> elastic;  ///< absent: rigid
};

enum class ContactState { kAuto, kClosed, kOpen };

struct ContactDescription {
  std::string name;
  std::array<int, 2> surfaces = {-1, -1};
  ContactState state = ContactState::kAuto;
  std::vector<Eigen::Vector3d> start;  ///< first estimates of contact points, ground frame [mm]
  std::optional<LayerOptions> layer;   ///< the elastic layers of its surfaces carry; absent: rigid
};

/// A point fixed to a body.
struct Attachment {
  int body = -1;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< body frame [mm]
};

/// A smooth surface that ligaments wrap on.
struct WrapDescription {
  std::string name;
  int line = 0;  ///< where its table stands in the file, for messages
  int body = -1;
  WrapShape shape;
  RigidTransform placement;  ///< from the surface's frame to that of the body [mm]
  std::optional<BoneFit> fit =
      {};  ///< of one that is fitted to its bone (specimen/fit_wraps.h): shape
           ///< and placement mean nothing until that is done
};

/// What a ligament wraps on, and how.
struct LigamentWraps {
  std::vector<int> wraps;  ///< indices into Scene::wraps, from the first end to the second
  /// A point on the side that is passed, frame of the wrap's body [mm]: one for each of `wraps`, or
  /// none.
  std::vector<Eigen::Vector3d> sides;
  bool anchors_inside =
      true;              ///< an end inside its own body's wrap is moved onto it; else that wrap
                         ///< is passed over
  double thickness = 0;  ///< of the ligament [mm]; half of it is added to the radii
};

struct LigamentDescription {
  std::string name;
  int line = 0;  ///< where its table stands in the file, for messages
  std::array<Attachment, 2> ends;
  ForceLaw law;
  LigamentWraps path;  ///< no wraps: straight
  /// toe-linear or quadratic with `reference_strain` and no `reference_length`: the slack length
  /// follows from the length at the start pose; reading the scene fills it in.
  std::optional<double> reference_strain;
  std::optional<double> reference_length;  ///< that `reference_strain` is told at, where given [mm]
};

struct ConditionDescription {
  std::string name;
  ConditionKind kind = ConditionKind::kFlexion;
  double value = 0;                                 ///< prescribed [rad] or [mm]
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  ///< kTranslation: unit vector
  int cardan_axis = 0;                              ///< kRotation: 0 x, 1 y, 2 z
  std::array<Attachment, 2> ends;                   ///< kDistance
};

struct LoadDescription {
  std::string name;
  int body = -1;
  bool moment = false;  ///< a moment [N mm] in place of a force [N]
  Eigen::Vector3d vector =
      Eigen::Vector3d::Zero();  ///< in the ground frame (dead) or the body frame (follower)
  Eigen::Vector3d at =
      Eigen::Vector3d::Zero();  ///< point of application, body frame [mm]; forces only
  bool follows_body = false;
  double scale = 1;  ///< factor on the vector wherever nothing varies it; 0: of tests alone
};

struct SweepDescription {
  bool varies_load =
      false;         ///< `vary = "NAME.scale"`: the factor on a load; else a condition's value
  int index = -1;    ///< of the condition or the load
  std::string vary;  ///< as written
  std::vector<double> values;              ///< [rad], [mm] or [-], in the order to be visited
  std::optional<WrittenRange> range = {};  ///< that they come from; none where the scene lists them
  bool arc_length = false;  ///< follow the path of equilibria through its limit points
  std::vector<SceneNumber> sensitivities =
      {};  ///< by which the results hold derivatives of each pose
};

/// A test of laxity: the swept load goes over its values at each of these angles of flexion, first
/// in the knee as it is and then without some ligaments.
struct LaxityDescription {
  int condition = -1;            ///< the prescribed flexion
  std::vector<double> flexions;  ///< [rad]
  std::vector<int> cut;          ///< ligaments; empty: only the knee as it is
};

/// A load whose scale is a function of time.
struct DriveDescription {
  enum class Shape { kPulse, kDecayingSine, kTable };
  int load = -1;
  Shape shape = Shape::kPulse;
  double start = 0, duration = 0;      ///< [s]; before `start` nothing
  double frequency = 0, decay = 0;     ///< decaying sine: [1/s], and e^(-decay t)
  std::vector<double> times, factors;  ///< table: [s], [-]; straight in between
};

/// A damper between the two bodies, along a line.
struct DamperDescription {
  std::string name;
  std::array<Attachment, 2> ends;
  double coefficient = 0;  ///< [N s/mm]
};

struct SimulationDescription {
  double time = 1, rate = 100;                        ///< [s], frames per second
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< ground frame [mm/s²]
  std::optional<double> flexion;                      ///< held there at the start [rad]
  double flexion_velocity = 0;                        ///< [rad/s]
  double restitution = 0;                             ///< 0 to 1
  double tolerance = 1e-9;
  double viscous_time = 0;  ///< τ of all ligaments: f(L) + τ f'(L) dL/dt [s]
  std::vector<int> hold;    ///< conditions that stay while the rest is released
  std::vector<DriveDescription> drives;
  std::vector<DamperDescription> dampers;
};

struct Scene {
  std::string title;
  std::string text;            ///< the whole file, for the result file
  std::filesystem::path file;  ///< where it was read
  double length_to_mm = 1;     ///< declared units, for messages
  double angle_to_rad = 1;
  double force_to_n = 1;
  std::vector<BodyDescription> bodies;
  std::optional<JointDescription> joint;
  std::vector<SurfaceDescription> surfaces;
  std::vector<ContactDescription> contacts;
  std::vector<WrapDescription> wraps;
  std::vector<LigamentDescription> ligaments;
  std::vector<ConditionDescription> conditions;
  std::vector<LoadDescription> loads;
  std::optional<SweepDescription> sweep;
  std::optional<LaxityDescription> laxity;
  std::optional<SimulationDescription> simulation;
  std::optional<CalibrationDescription> calibration;

  [[nodiscard]] int fixed_body() const {
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (bodies[i].fixed) return static_cast<int>(i);
    return -1;
  }
  /// The mesh that a patch is cut from, its own or that of its body; null where neither names one.
  [[nodiscard]] const MeshFile* mesh_of(const SurfaceDescription& surface) const {
    if (surface.patch.mesh) return &*surface.patch.mesh;
    const BodyDescription& body = bodies[static_cast<std::size_t>(surface.body)];
    return body.mesh ? &*body.mesh : nullptr;
  }
  /// The moving body (one today).
  [[nodiscard]] int moving_body() const {
    for (std::size_t i = 0; i < bodies.size(); ++i)
      if (!bodies[i].fixed) return static_cast<int>(i);
    return -1;
  }
};

}  // namespace condyle
