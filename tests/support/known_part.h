#pragma once

/// A surface of which only a part is known, the rest being its extrapolation.

#include <functional>
#include <memory>
#include <utility>

#include "condyle/surface/surface.h"

namespace condyle::test {

class KnownPart : public Surface {
 public:
  /// `edge` tells how far within the known part a point of the surface lies [mm], < 0 beyond.
  using Edge = std::function<double(const Eigen::Vector3d& c)>;

  KnownPart(std::shared_ptr<const Surface> whole, Edge edge)
      : whole_(std::move(whole)), edge_(std::move(edge)) {}

  [[nodiscard]] SurfacePoint evaluate(const Place& place) const override {
    return whole_->evaluate(place);
  }
  [[nodiscard]] Place moved(const Place& place,
                            const SurfacePoint& at,
                            const Eigen::Vector3d& dc) const override {
    return whole_->moved(place, at, dc);
  }
  [[nodiscard]] Place closest(const Eigen::Vector3d& p, const Place& start) const override {
    return whole_->closest(p, start);
  }
  [[nodiscard]] Place seed(const Eigen::Vector3d& p) const override { return whole_->seed(p); }
  [[nodiscard]] double edge_distance(const Place& place) const override {
    return edge_(whole_->evaluate(place).c);
  }
  [[nodiscard]] std::vector<Place> samples(double spacing) const override {
    std::vector<Place> known;
    for (const Place& place : whole_->samples(spacing))
      if (edge_distance(place) >= 0) known.push_back(place);
    return known;
  }

  [[nodiscard]] Extent extent() const override { return whole_->extent(); }
  [[nodiscard]] std::unique_ptr<Surface> translated(const Eigen::Vector3d& d) const override {
    return std::make_unique<KnownPart>(
        whole_->translated(d), [edge = edge_, d](const Eigen::Vector3d& c) { return edge(c - d); });
  }

 private:
  std::shared_ptr<const Surface> whole_;
  Edge edge_;
};

}  // namespace condyle::test
