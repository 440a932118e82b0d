#pragma once

/// Pairs of small spline patches with seeded roughness near contact, and all minima of the gap
/// between them by brute force: a dense grid on either patch, every low point of it refined by
/// Newton.

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "condyle/contact/contact_search.h"
#include "condyle/contact/settle_places.h"
#include "support/height_patch.h"
#include "support/random.h"

namespace condyle::test {

/// A sum of waves of random directions, phases and lengths.
class Roughness {
 public:
  Roughness(Random& random, double amplitude) {
    for (int k = 0; k < 6; ++k) {
      const double angle = random.between(0, M_PI), length = random.between(5, 16);
      const double size = amplitude / 2.5 * random.between(0.5, 1);
      waves_.push_back({2 * M_PI / length * std::cos(angle), 2 * M_PI / length * std::sin(angle),
                        random.between(0, 2 * M_PI), size});
    }
  }
  [[nodiscard]] double at(double u, double v) const {
    double height = 0;
    for (const Eigen::Vector4d& w : waves_) height += w[3] * std::sin(w[0] * u + w[1] * v + w[2]);
    return height;
  }

 private:
  std::vector<Eigen::Vector4d> waves_;
};

/// 24 x 20 mm of a body that bends by 1/a and 1/b [1/mm] downwards from the height 0 at its middle,
/// with knots `knot` mm apart; the solid lies below, or above where `upside_down`.
inline std::shared_ptr<const Patch> bumpy_patch(
    double a, double b, const Roughness& roughness, double knot, bool upside_down) {
  PatchData data = height_patch(12, 10, knot, [&](double u, double v) {
    const double z = -a * u * u / 2 - b * v * v / 2 + roughness.at(u, v);
    return upside_down ? -z : z;
  });
  data.orientation = upside_down ? -1 : 1;
  return std::make_shared<Patch>(data);
}

/// A condyle above a shallow plateau, `amplitude` [mm] of roughness on both.
inline ContactPair bumpy_pair(Random& random, double amplitude) {
  ContactPair pair;
  pair.name = "bumpy";
  const double knot = random.between(1.2, 2.2);
  pair.on_B = bumpy_patch(random.between(0.02, 0.05), random.between(0.02, 0.05),
                          Roughness(random, amplitude), knot, true);
  pair.on_A = bumpy_patch(random.between(-0.015, 0.015), random.between(-0.015, 0.015),
                          Roughness(random, amplitude), knot, false);
  return pair;
}

/// All minima with gap < cutoff [mm] that lie within both known parts by more than `margin` [mm].
class BruteForce {
 public:
  BruteForce(const ContactPair& pair, double step) : pair_(pair) {
    sheet(*pair.on_B, step, on_B_);
    sheet(*pair.on_A, step, on_A_);
  }

  std::vector<GapMinimum> minima(const RigidTransform& X, double cutoff, double margin = 0.02) {
    std::vector<GapMinimum> minima;
    scan(on_A_, *pair_.on_B, X, X, true, cutoff, margin, minima);
    scan(on_B_, *pair_.on_A, X.inverse(), X, false, cutoff, margin, minima);
    std::sort(minima.begin(), minima.end(),
              [](const GapMinimum& a, const GapMinimum& b) { return a.gap < b.gap; });
    return minima;
  }

 private:
  /// Rows of places; one that is unknown has a gap that is not a number.
  struct Sheet {
    std::vector<std::vector<Place>> places;
    std::vector<std::vector<Eigen::Vector3d>> points;
    std::vector<std::vector<double>> gaps;
    std::vector<std::vector<Place>> opposite;
  };

  static void sheet(const Surface& surface, double step, Sheet& sheet) {
    const auto& patch = dynamic_cast<const Patch&>(surface);
    const int nu = static_cast<int>((patch.u_max() - patch.u_min()) / step),
              nv = static_cast<int>((patch.v_max() - patch.v_min()) / step);
    for (int i = 0; i <= nu; ++i) {
      sheet.places.emplace_back();
      sheet.points.emplace_back();
      for (int j = 0; j <= nv; ++j) {
        sheet.places.back().push_back(
            Patch::place(patch.u_min() + (patch.u_max() - patch.u_min()) * i / nu,
                         patch.v_min() + (patch.v_max() - patch.v_min()) * j / nv));
        sheet.points.back().push_back(patch.evaluate_frame(sheet.places.back().back()).c);
      }
      sheet.gaps.emplace_back(sheet.places.back().size());
      sheet.opposite.emplace_back(sheet.places.back().size());
    }
  }

  void scan(Sheet& sheet,
            const Surface& other,
            const RigidTransform& to_other,
            const RigidTransform& X,
            bool from_A,
            double cutoff,
            double margin,
            std::vector<GapMinimum>& minima) {
    for (std::size_t i = 0; i < sheet.places.size(); ++i)
      for (std::size_t j = 0; j < sheet.places[i].size(); ++j) {
        const Eigen::Vector3d p = to_other * sheet.points[i][j];
        Place closest =
            j > 0 ? sheet.opposite[i][j - 1] : (i > 0 ? sheet.opposite[i - 1][j] : other.seed(p));
        SurfacePoint at = other.evaluate_frame(closest);
        for (int k = 0; k < 4; ++k) {
          const Eigen::Vector3d d = p - at.c, t = d - d.dot(at.n) * at.n;
          if (t.squaredNorm() < 1e-6) break;
          closest = other.moved(closest, at, t);
          at = other.evaluate_frame(closest);
        }
        sheet.opposite[i][j] = closest;
        sheet.gaps[i][j] = at.n.dot(p - at.c);
      }
    const auto lowest = [&](std::size_t i, std::size_t j) {
      for (std::size_t k = i == 0 ? 0 : i - 1; k < std::min(i + 2, sheet.gaps.size()); ++k)
        for (std::size_t l = j == 0 ? 0 : j - 1; l < std::min(j + 2, sheet.gaps[k].size()); ++l)
          if (sheet.gaps[k][l] < sheet.gaps[i][j]) return false;
      return true;
    };
    for (std::size_t i = 0; i < sheet.places.size(); ++i)
      for (std::size_t j = 0; j < sheet.places[i].size(); ++j) {
        if (sheet.gaps[i][j] > cutoff + 0.01 || !lowest(i, j)) continue;
        const Place &own = sheet.places[i][j], &there = sheet.opposite[i][j];
        add(from_A ? ContactPlaces{there, own} : ContactPlaces{own, there}, X, cutoff, margin,
            minima);
      }
  }

  void add(ContactPlaces places,
           const RigidTransform& X,
           double cutoff,
           double margin,
           std::vector<GapMinimum>& minima) const {
    ContactLinearization at;
    if (settle_places(pair_, X, {2, true}, places, at) != Settled::kThere) return;
    const GapMinimum minimum = minimum_at(pair_, places, at);
    const bool same = std::any_of(minima.begin(), minima.end(), [&](const GapMinimum& known) {
      return (known.point_B - minimum.point_B).norm() < 1e-5;
    });
    if (minimum.gap < cutoff && minimum.edge > margin && !same) minima.push_back(minimum);
  }

  const ContactPair& pair_;
  Sheet on_B_, on_A_;
};

/// A little turned and shifted; its height is arbitrary.
inline RigidTransform bumpy_pose(Random& random) {
  const Eigen::Vector3d turn(random.between(-0.12, 0.12), random.between(-0.12, 0.12),
                             random.between(-3, 3));
  return {exp_rotation({turn.x(), turn.y(), 0}) * exp_rotation({0, 0, turn.z()}),
          {random.between(-5, 5), random.between(-4, 4), 0}};
}

}  // namespace condyle::test
