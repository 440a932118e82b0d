#pragma once

/// A system of bodies as a network of components [Tokad 1992]: what there is, as plain data. Units
/// inside: mm, N, s, tonne, rad.

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "condyle/contact/contact_law.h"
#include "condyle/contact/contact_places.h"
#include "condyle/elements/force_law.h"
#include "condyle/elements/kinematic_condition.h"
#include "condyle/elements/line_path.h"
#include "condyle/elements/load.h"
#include "condyle/network/mass_properties.h"

namespace condyle {

inline constexpr int kGround = -1;  ///< a port fixed to the ground
inline constexpr int kNoBody = -2;  ///< a port that an across driver moves

struct NetworkBody {
  std::string name;
  std::optional<MassProperties> mass;                   ///< absent: ideal, for statics only
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();  ///< port 0, body frame [mm]
  bool point_mass = false;  ///< all at the mass centre, where its ports must be
};

struct NetworkPort {
  std::string name;
  int body = kGround;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< body frame, or ground frame [mm]
};

/// Pulls two ports together: with a law, with a viscosity, or both.
///   f(L) + τ f'(L) dL/dt + c dL/dt; where f >= 0, the viscous ligament never pushes.
struct LineComponent {
  std::string name;
  int from = 0, to = 0;         ///< ports
  std::optional<ForceLaw> law;  ///< absent: a damper
  double damping = 0;           ///< c [N s/mm]
  double viscous_time = 0;      ///< τ [s]
  /// Of a line from the ground to a body that is not straight.
  std::shared_ptr<const LinePath> path = nullptr;
};

/// Through driver: a load on a body; `scale`, where there is one, is its scale over time in place of load.scale.
struct ForceDriver {
  std::string name;
  int body = 0;
  Load load;
  std::function<double(double t)> scale;
};

/// Across driver: the motion of a port.
struct DrivenPoint {
  Eigen::Vector3d position, velocity, acceleration;  ///< [mm], [mm/s], [mm/s²]
};
struct MotionDriver {
  std::string name;
  int port = 0;
  std::function<DrivenPoint(double t)> motion;
};

/// Two ports stay together and turn freely.
struct BallJoint {
  std::string name;
  int from = 0, to = 0;  ///< ports
};

/// Rigid contact between a surface fixed to the ground and one on a body, along the common normal.
struct ContactComponent {
  std::string name;
  int body = 0;
  std::shared_ptr<const Surface> on_ground, on_body;
  bool opens = true;  ///< else it is held closed and may pull
  /// ContactDetection looks where else the surfaces come near: one that loses its place
  /// waits for a new one instead of ending the motion.
  bool is_detected = false;

  /// B is the ground, A the body.
  [[nodiscard]] SurfacePair surfaces() const { return {*on_ground, *on_body}; }
};

/// Contact of a body with the ground by a law without unknowns, such as elastic layers. Its storage is
/// that of one motion at a time.
struct PotentialComponent {
  std::string name;
  int body = 0;
  std::shared_ptr<ContactPotential> potential;
};

/// A kinematic condition on a body, its value a function of time (absent: as it stands).
struct DrivenValue {
  double value, rate, acceleration;
};
struct ConditionComponent {
  std::string name;
  int body = 0;
  KinematicCondition condition;
  std::function<DrivenValue(double t)> value;
};

struct Network {
  double length = 30;  ///< L [mm] of what moves: tolerances of lengths are measured by it
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [mm/s²]
  std::vector<NetworkBody> bodies;
  std::vector<NetworkPort> ports;
  std::vector<LineComponent> lines;
  std::vector<ForceDriver> forces;
  std::vector<MotionDriver> motions;
  std::vector<BallJoint> joints;
  std::vector<ContactComponent> contacts;
  std::vector<PotentialComponent> potentials;
  std::vector<ConditionComponent> conditions;
};

/// Adds a port and returns its number.
int add_port(Network& network, const std::string& name, int body, const Eigen::Vector3d& at);

struct BodyState {
  RigidTransform X;                                 ///< of the body frame in the ground frame
  Eigen::Vector3d v = Eigen::Vector3d::Zero();      ///< of the reference port [mm/s]
  Eigen::Vector3d omega = Eigen::Vector3d::Zero();  ///< ground frame [rad/s]
};

/// Where a contact is on its two surfaces, kept from one moment to the next.
struct MovingContact {
  ContactPlaces places;
  bool closed = false;
  bool followed = true;  ///< else it waits: the surfaces are not near each other anywhere new
};

struct NetworkState {
  double t = 0;  ///< [s]
  std::vector<BodyState> bodies;
  std::vector<MovingContact> contacts;
};

}  // namespace condyle
