#pragma once

/// A surface as the search for contacts sees it: samples with their osculating quadrics, and by how
/// much the surface may rise over each of these, towards the solid that touches it.
///
/// What lies between the samples is allowed for: within a cell, half the way to the neighbours, the
/// curvature changes by no more than it does on the way to them. The samples hang in a binary tree
/// of clusters; quadrics are fitted to these where they are asked for (cluster_quadrics.h). A surface without samples tells nothing, unless it bends evenly
/// (plane, sphere, cylinder).

#include <Eigen/Core>

#include <array>
#include <vector>

#include "condyle/contact/dividing_quadric.h"
#include "condyle/contact/quadric_fit.h"
#include "condyle/surface/surface.h"

namespace condyle {

/// Over a range of distances from a sample [1/mm]; below zero where the surface bends away.
struct Rise {
  double over_quadric = 0;  ///< greatest (2 h - tᵀ K t)/t²; infinite where it turns away too far
  double over_plane = 0;    ///< greatest 2 h/t²: a paraboloid of revolution above all of it
};

class SurfaceCover {
 public:
  struct Cluster {
    Eigen::Vector3d center;               ///< of its samples [mm]
    double spread = 0;                    ///< farthest sample from there [mm]
    double radius = 0;                    ///< of a ball that holds their cells [mm]
    int first = 0, last = 0;              ///< range in order
    int parent = -1;                      ///< -1: the root
    std::array<int, 2> child = {-1, -1};  ///< -1: a leaf
  };

  /// `samples` of the surface, with that spacing [mm].
  SurfaceCover(const Surface& surface, double spacing, std::vector<Place> samples);
  SurfaceCover(const Surface& surface, double spacing)
      : SurfaceCover(surface, spacing, surface.samples(spacing)) {}

  [[nodiscard]] double spacing() const { return spacing_; }
  [[nodiscard]] const Surface& surface() const { return *surface_; }
  [[nodiscard]] int size() const { return static_cast<int>(cells_.size()); }
  [[nodiscard]] const Place& place(int sample) const { return places_[at(sample)]; }
  [[nodiscard]] const SurfacePoint& sample(int sample) const { return cells_[at(sample)].at; }
  [[nodiscard]] const SurfaceCell& cell(int sample) const { return cells_[at(sample)]; }
  [[nodiscard]] double edge_distance(int sample) const { return edge_[at(sample)]; }
  /// Up to eight nearest samples within three spacings; -1 fills up.
  [[nodiscard]] const std::array<int, 8>& neighbours(int sample) const {
    return neighbours_[at(sample)];
  }
  /// Half the way to the farthest neighbour [mm], and the change of the curvature as far as the
  /// neighbours [1/mm].
  [[nodiscard]] double cell_radius(int sample) const { return cells_[at(sample)].radius; }
  [[nodiscard]] double cell_change(int sample) const { return change_[at(sample)]; }
  [[nodiscard]] const std::vector<Cluster>& clusters() const { return clusters_; }
  [[nodiscard]] const Cluster& cluster(int index) const { return clusters_[at(index)]; }
  [[nodiscard]] int in_order(int k) const { return order_[at(k)]; }
  [[nodiscard]] bool bends_evenly() const { return even_; }
  /// No two samples are farther apart [mm].
  [[nodiscard]] double extent() const { return extent_; }

  /// The sample nearest to a point, of all within `radius` [mm]; -1 where there are none. Adds to `looked_at` the
  /// points that take as long.
  [[nodiscard]] int nearest_within(const Eigen::Vector3d& point,
                                   double radius,
                                   long& looked_at) const;

  /// Of two samples the nearer one; the other where one is -1.
  [[nodiscard]] int nearer(const Eigen::Vector3d& point, int one, int another) const;

  /// All cells; samples at an edge stand for what lies between them and the edge as well.
  [[nodiscard]] const CellColumns& columns() const { return columns_; }
  [[nodiscard]] int leaf(int sample) const { return leaf_[at(sample)]; }

 private:
  [[nodiscard]] static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  void enclose(int sample);
  void lay_columns();
  int build(int first, int last, int parent);
  void enclose(Cluster& cluster) const;
  struct Candidate;
  void find_nearest(int cluster, const Eigen::Vector3d& point, Candidate& nearest) const;

  const Surface* surface_;
  double spacing_;
  bool even_;
  std::vector<Place> places_;
  std::vector<double> edge_;
  std::vector<std::array<int, 8>> neighbours_;
  std::vector<SurfaceCell> cells_;  ///< of the samples
  CellColumns columns_;
  std::vector<double> change_;
  std::vector<int> order_, leaf_;        ///< leaf_: the cluster of each sample
  std::vector<Eigen::Vector3d> points_;  ///< of the samples, in order
  std::vector<Cluster> clusters_;
  double extent_ = 0;
};

/// Of a plane, sphere or cylinder as far as `radius` [mm] from any of its points.
[[nodiscard]] Rise even_rise(double radius, const Eigen::Matrix3d& K);

}  // namespace condyle
