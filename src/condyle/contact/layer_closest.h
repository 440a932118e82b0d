#pragma once

/// The closest points of a surface to four points that move little from one question to the next.
/// That of a point displaced by v moves by du = (h⁻¹)ᵃᵇ c_b·v, h = a - φ b with the metric a and
/// the second form b, so Newton begins where the closest point should be and mostly ends there: one
/// evaluation of the surface. φ and n there are taken to second and first order from the place where
/// the last step began, which is exact to round-off for the steps that end the iteration.
///
/// Four at once since all but the choice of the knot cell is the same arithmetic for each.

#include <Eigen/Core>

#include <optional>

#include "condyle/surface/patch.h"
#include "condyle/surface/patch_bends.h"
#include "condyle/surface/patch_cells.h"

namespace condyle {

/// Coordinates of four points.
using FourPoints = double[3][4];

/// In the frame of the body that carries the surface.
struct alignas(32) FourClosestPoints {
  FourPoints at = {};         ///< the points whose closest points they are [mm]
  double phi[4] = {};         ///< their signed distances [mm]
  FourPoints n = {};          ///< ∂φ, out of the solid
  double H[6][4] = {};        ///< ∂²φ = -K (I - φ K)⁻¹ [1/mm]: xx, xy, xz, yy, yz, zz
  FourPoints place = {};      ///< numbers of their places
  double turn[2][3][4] = {};  ///< of u and v with the points; patches only
  double step[4] = {-1, -1, -1, -1};  ///< the last to each [mm]; below 0 nothing is known

  [[nodiscard]] bool known() const { return step[0] >= 0; }
  [[nodiscard]] Place place_of(int k) const { return {{place[0][k], place[1][k], place[2][k]}}; }
  /// Four times the k-th.
  [[nodiscard]] FourClosestPoints repeated(int k) const;
};

/// Constant: shared between threads.
class LayerClosestPoints {
 public:
  /// The surface is referred to.
  explicit LayerClosestPoints(const Surface& surface);
  LayerClosestPoints(const LayerClosestPoints&) = delete;
  LayerClosestPoints& operator=(const LayerClosestPoints&) = delete;

  [[nodiscard]] const Surface& surface() const { return surface_; }

  /// Does finding one cost as much as finding four? On a patch it does.
  [[nodiscard]] bool finds_in_fours() const { return patch_ != nullptr; }

  /// The closest points of p, searched from those of points near them, `from`, which may be
  /// `closest` itself. `step`: of the last iteration at most [mm]; φ is then good to its cube, n to
  /// its square. Of a point outside that is known to be, φ may be told too small by a step of 0.2 mm
  /// at most. Of points whose bits are not in `asked` `closest` stays as it is,
  /// unless they are found in fours. Returns how many points of surfaces are looked at in the same time, about.
  long find(const FourPoints& p,
            const FourClosestPoints& from,
            double step,
            FourClosestPoints& closest,
            unsigned asked = 15) const;

  /// How the surface bends about the place of one of them.
  [[nodiscard]] BendBound bends_about(const FourClosestPoints& closest, int k) const {
    return bends_ ? bends_->about(closest.place[0][k], closest.place[1][k]) : BendBound();
  }

  /// The same from anywhere.
  long find_anew(const FourPoints& p, FourClosestPoints& closest) const;

 private:
  /// Bits of those that were not found.
  unsigned follow(const FourPoints& p,
                  const FourClosestPoints& from,
                  double step,
                  FourClosestPoints& closest) const;
  [[nodiscard]] long one_by_surface() const;
  void find_by_surface(const FourPoints& p,
                       int k,
                       const Place& start,
                       FourClosestPoints& closest) const;

  const Surface& surface_;
  const Patch* patch_;  ///< null where it is none
  std::optional<PatchCells> cells_;
  std::optional<PatchBends> bends_;
  double u_[2] = {}, v_[2] = {};  ///< how far places are followed
};

}  // namespace condyle
