#pragma once

/// What is told of a contact at one pose: plain data for results and pictures. Units inside: mm, N,
/// rad. B is the fixed body (ground frame), A the moving one.

#include <Eigen/Core>

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "condyle/math/no_number.h"
#include "condyle/math/rigid_transform.h"

namespace condyle {

struct ContactLinearization;

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

/// What a pair of elastic layers says beside its force (contact/layer_contact.h).
struct LayerResult {
  double area = 0;           ///< [mm²]
  double mean_pressure = 0;  ///< sum of pressures times areas, over the area [N/mm²]
  double peak_pressure = 0;  ///< [N/mm²]
  double deepest = 0;        ///< [mm]
  double energy = 0;         ///< [N mm]
  double error = 0;          ///< of the force by the lattice, relative
  double lost =
      0;  ///< part of the force that an edge takes away: it faces what lies beyond one, or
          ///< fades at its own
  double lateral =
      0;           ///< λ/a: length over which a layer gives way sideways, over the radius of the
                   ///< area; above 1 pressures are those of the model rather than of tissue
  int points = 0;  ///< of the lattice, in contact
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< on the moving body, ground frame [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< about O_A, ground frame [N mm]
};

/// Pressure at a point of one of two elastic layers. The force is the mean over the sides that have
/// points: the sum of pressure times area of both, halved where there are two.
struct PressurePoint {
  bool on_A = false;                                ///< of the moving body's surface
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< u, v of a patch
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< in the frame of its body [mm]
  double pressure = 0;                              ///< [N/mm²]
  double depth = 0;                                 ///< [mm]
  double area = 0;                                  ///< that it stands for [mm²]
};

/// A pair of surfaces. Closed with one or more points; open, it tells where the gap is smallest.
/// What a law of its own says beside that (contact_law.h) gets a field here.
struct ContactResult {
  bool closed = false;
  ContactShape shape = ContactShape::kPoint;
  double force = 0;  ///< sum over the points [N]
  /// Where the resultant of the points acts, ground frame [mm]; of an open contact the nearest
  /// point.
  Eigen::Vector3d resultant_ground = Eigen::Vector3d::Constant(kNoNumber);
  std::vector<ContactPointResult>
      points;                        ///< closed: those that carry; open: the nearest one, force 0
  std::optional<LayerResult> layer;  ///< of a pair of elastic layers, closed
  std::vector<PressurePoint> pressures;  ///< of it: points of B, then of A
};

/// A point of contact with its force [N] and its distance from the nearest edge [mm]; whether that
/// counts as on the edge is left to the caller.
[[nodiscard]] ContactPointResult describe_point(const ContactLinearization& at,
                                                double force,
                                                double edge);

/// Force and resultant of a closed contact from its points.
void set_resultant(ContactResult& contact);

/// The point of a contact that carries most; of an open contact the nearest one. Null where it holds
/// none.
[[nodiscard]] const ContactPointResult* strongest_point(const ContactResult& contact);

/// Where a contact acts on the moving body or, in the ground frame, on the fixed one [mm]: of a layer its centre of
/// pressure, else its strongest point. Nothing where it holds none.
[[nodiscard]] std::optional<Eigen::Vector3d> acting_place(const ContactResult& contact,
                                                          const RigidTransform& X_BA,
                                                          bool on_moving);

/// Empty as a new one, in the memory of before.
void clear(ContactResult& contact);

}  // namespace condyle
