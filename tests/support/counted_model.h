#pragma once

/// A model that counts how often its surfaces and elements are asked.

#include <memory>
#include <utility>

#include "condyle/equilibrium/model.h"

namespace condyle::test {

struct Asked {
  long surfaces = 0;  ///< for a point, with or without curvature, or for the closest place
  long elements = 0;  ///< for their force
};

class CountedSurface : public Surface {
 public:
  CountedSurface(std::shared_ptr<const Surface> inner, Asked& asked)
      : inner_(std::move(inner)), asked_(asked) {}

  [[nodiscard]] SurfacePoint evaluate(const Place& place) const override {
    ++asked_.surfaces;
    return inner_->evaluate(place);
  }
  [[nodiscard]] SurfacePoint evaluate_frame(const Place& place) const override {
    ++asked_.surfaces;
    return inner_->evaluate_frame(place);
  }
  [[nodiscard]] Place closest(const Eigen::Vector3d& p, const Place& start) const override {
    ++asked_.surfaces;
    return inner_->closest(p, start);
  }
  [[nodiscard]] Place moved(const Place& place,
                            const SurfacePoint& at,
                            const Eigen::Vector3d& dc) const override {
    return inner_->moved(place, at, dc);
  }
  [[nodiscard]] Place place_of(const Eigen::Vector3d& numbers) const override {
    return inner_->place_of(numbers);
  }
  [[nodiscard]] Place seed(const Eigen::Vector3d& p) const override { return inner_->seed(p); }
  [[nodiscard]] double edge_distance(const Place& place) const override {
    return inner_->edge_distance(place);
  }
  [[nodiscard]] bool bends_evenly() const override { return inner_->bends_evenly(); }
  [[nodiscard]] std::vector<Place> samples(double spacing) const override {
    return inner_->samples(spacing);
  }
  [[nodiscard]] Extent extent() const override { return inner_->extent(); }
  [[nodiscard]] std::unique_ptr<Surface> translated(const Eigen::Vector3d& d) const override {
    return std::make_unique<CountedSurface>(inner_->translated(d), asked_);
  }

 private:
  std::shared_ptr<const Surface> inner_;
  Asked& asked_;
};

/// `asked` must outlive the model.
inline Model counted(Model model, Asked& asked) {
  for (ContactPair& pair : model.pairs) {
    pair.on_B = std::make_shared<CountedSurface>(pair.on_B, asked);
    pair.on_A = std::make_shared<CountedSurface>(pair.on_A, asked);
  }
  for (LineElement& element : model.elements)
    element.law = CustomLaw{[law = element.law, &asked](double length) {
      ++asked.elements;
      return tension(law, length);
    }};
  return model;
}

}  // namespace condyle::test
