#include "condyle/reference/polynomial_surface.h"

#include <algorithm>
#include <cmath>

namespace condyle {
namespace {

class PolynomialSurface final : public Surface {
 public:
  explicit PolynomialSurface(const HeightSurface& heights)
      : heights_(heights),
        surface_(
            make_polynomial(heights.origin, heights.axes, heights.terms, heights.solid_below)) {}

  [[nodiscard]] SurfacePoint evaluate(const Place& place) const override {
    return surface_->evaluate(place);
  }
  [[nodiscard]] SurfacePoint evaluate_frame(const Place& place) const override {
    return surface_->evaluate_frame(place);
  }
  [[nodiscard]] Place moved(const Place& place,
                            const SurfacePoint& at,
                            const Eigen::Vector3d& dc) const override {
    return surface_->moved(place, at, dc);
  }
  [[nodiscard]] Place closest(const Eigen::Vector3d& p, const Place& start) const override {
    return surface_->closest(p, start);
  }
  [[nodiscard]] Place seed(const Eigen::Vector3d& p) const override { return surface_->seed(p); }
  [[nodiscard]] double edge_distance(const Place& place) const override {
    return distance_to_outline(heights_, coordinates_of(heights_, place.numbers));
  }
  /// As far apart on the steepest part as asked, nearer elsewhere.
  [[nodiscard]] std::vector<Place> samples(double spacing) const override {
    std::vector<Place> places;
    if (heights_.outline.empty()) return places;
    double steepest = 1;
    for (const Eigen::Vector2d& at : grid_within(heights_, 2 * spacing)) {
      const HeightPoint point = condyle::evaluate(heights_, at);
      steepest = std::max({steepest, point.t[0].norm(), point.t[1].norm()});
    }
    for (const Eigen::Vector2d& at : grid_within(heights_, spacing / std::min(steepest, 3.0)))
      places.push_back({condyle::evaluate(heights_, at).c});
    return places;
  }
  /// Of the points that the polynomial stands for: they lie within their outline.
  [[nodiscard]] Extent extent() const override {
    const auto n = static_cast<double>(heights_.outline.size());
    if (n == 0) return {surface_->extent().center};
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& corner : heights_.outline) middle += corner / n;
    double square = 0;
    for (const Eigen::Vector2d& corner : heights_.outline)
      square += (corner - middle).squaredNorm() / n;
    return {condyle::evaluate(heights_, middle).c, std::sqrt(square / 2)};
  }
  [[nodiscard]] std::unique_ptr<Surface> translated(const Eigen::Vector3d& d) const override {
    HeightSurface moved = heights_;
    moved.origin += d;
    return std::make_unique<PolynomialSurface>(moved);
  }

 private:
  HeightSurface heights_;
  std::unique_ptr<Surface> surface_;
};

}  // namespace

std::shared_ptr<const Surface> make_surface(const HeightSurface& surface) {
  return std::make_shared<const PolynomialSurface>(surface);
}

std::vector<FittedSurface> with_polynomials(std::vector<FittedSurface> surfaces,
                                            const std::vector<HeightFit>& heights) {
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (heights[i].fitted) surfaces[i].surface = make_surface(heights[i].surface);
  }
  return surfaces;
}

}  // namespace condyle
