#pragma once

/// A tensor-product B-spline patch with continuous curvature (C2), c(u,v) = Σ B_i(u) B_j(v) P_ij.
///
/// Plain data and one evaluation: everything that contact asks for at (u,v) in one pass. Knots are
/// clamped or uniform, non-decreasing; degree 2 to 5. Outside its parameter box each basis function
/// goes on as its own second-order Taylor expansion at the end, so that c stays C2 and Newton never
/// falls off; `edge_distance` tells.
///
/// The normal is the side of c_u x c_v when `orientation` is +1, the other side when -1; it points
/// out of the bone. References: [Piegl and Tiller 1997, ch. 2-3]; docs/surface.md.

#include "condyle/surface/surface.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace condyle {

/// Control net, knots and the known region of a patch: what /patches/SURFACE of a result file
/// holds.
struct PatchData {
  std::array<int, 2> degree = {3, 3};
  std::vector<double> knots_u,
      knots_v;         ///< sizes nu + degree + 1, nv + degree + 1; in mm of chart length
  int nu = 0, nv = 0;  ///< number of control points
  std::vector<Eigen::Vector3d>
      control_points;   ///< [nu * nv], v fastest, [mm] in the frame of the body
  int orientation = 1;  ///< +1: out of the bone along c_u x c_v; -1: against it

  /// Known region: on the grid of (mask_nu x mask_nv) equal cells of the parameter box, the
  /// distance [mm] from the cell corner to the edge of the data, positive inside;
  /// (mask_nu+1)*(mask_nv+1) values, v fastest. Empty: the whole box is known.
  int mask_nu = 0, mask_nv = 0;
  std::vector<double> mask;
};

/// Position and partial derivatives at (u,v), [mm] and per unit of parameter.
struct PatchDerivatives {
  Eigen::Vector3d c, c_u, c_v, c_uu, c_uv, c_vv;
};

class Patch final : public Surface {
 public:
  /// Asserts that the sizes of `data` agree.
  explicit Patch(PatchData data);

  [[nodiscard]] const PatchData& data() const { return data_; }
  [[nodiscard]] double u_min() const { return u_.min; }
  [[nodiscard]] double u_max() const { return u_.max; }
  [[nodiscard]] double v_min() const { return v_.min; }
  [[nodiscard]] double v_max() const { return v_.max; }

  /// Of a patch, any.
  [[nodiscard]] static Place place(double u, double v) { return {{u, v, 0}}; }

  [[nodiscard]] PatchDerivatives derivatives(double u, double v) const;

  [[nodiscard]] SurfacePoint evaluate(const Place& at) const override;
  [[nodiscard]] SurfacePoint evaluate_frame(const Place& at) const override;
  [[nodiscard]] Place place_of(const Eigen::Vector3d& numbers) const override { return {numbers}; }
  [[nodiscard]] Place moved(const Place& from,
                            const SurfacePoint& at,
                            const Eigen::Vector3d& dc) const override;
  [[nodiscard]] Place closest(const Eigen::Vector3d& p, const Place& start) const override;
  [[nodiscard]] Place seed(const Eigen::Vector3d& p) const override;
  [[nodiscard]] double edge_distance(const Place& at) const override;
  [[nodiscard]] std::vector<Place> samples(double spacing) const override;
  [[nodiscard]] Extent extent() const override { return extent_; }
  [[nodiscard]] std::unique_ptr<Surface> translated(const Eigen::Vector3d& d) const override;

 private:
  struct SeedIndex;

  /// One direction of the tensor product: knots and, for every span, the basis as polynomials.
  struct Direction {
    int degree;
    int spans;
    double min, max;
    double inverse_step;               ///< 1 / knot step for uniform knots, else 0
    std::vector<double> breaks;        ///< spans + 1
    std::vector<double> coefficients;  ///< [span][power][basis function], in t - breaks[span]
  };
  struct Basis;
  [[nodiscard]] static Direction make_direction(const std::vector<double>& knots, int degree);
  static int evaluate_direction(const Direction& direction, double t, Basis& basis);
  [[nodiscard]] PatchDerivatives bicubic_derivatives(double u, double v, bool second) const;
  [[nodiscard]] PatchDerivatives general_derivatives(double u, double v) const;
  [[nodiscard]] SurfacePoint point_from(const PatchDerivatives& d) const;
  [[nodiscard]] Extent extent_of(const std::vector<Place>& places,
                                 const std::vector<Eigen::Vector3d>& points) const;

  PatchData data_;
  Direction u_, v_;
  std::vector<Eigen::Vector4d> net_;  ///< control points, padded for aligned loads
  double size_ = 0;                   ///< twice the reach of the control net from its mean [mm]
  Extent extent_;                     ///< of the seeds that are known
  std::shared_ptr<const SeedIndex> seeds_;
  Eigen::Vector3d seeds_moved_ = Eigen::Vector3d::Zero();  ///< since the seeds were laid [mm]
};

}  // namespace condyle
