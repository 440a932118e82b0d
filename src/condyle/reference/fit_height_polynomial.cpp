#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/math/decompositions.h"
#include "condyle/reference/fit_heights.h"

namespace condyle {

using Eigen::Vector2d;
using Eigen::Vector3d;

void fit_height_polynomial(const std::vector<Vector3d>& points,
                           const std::vector<double>& weights,
                           int degree,
                           HeightSurface& surface) {
  std::vector<Vector2d> at;
  double reach = 1e-9;  // coordinates over it lie within 1, for the sake of the condition
  for (const Vector3d& p : points) {
    at.push_back(coordinates_of(surface, p));
    reach = std::max(reach, at.back().cwiseAbs().maxCoeff());
  }
  std::vector<PolynomialTerm> terms;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j) terms.push_back({i, j, 0});
  Eigen::MatrixXd A(std::ssize(points), std::ssize(terms));
  Eigen::VectorXd b(std::ssize(points));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double weight = std::sqrt(weights[k]);
    const auto row = static_cast<Eigen::Index>(k);
    for (std::size_t t = 0; t < terms.size(); ++t) {
      A(row, static_cast<Eigen::Index>(t)) = weight * std::pow(at[k].x() / reach, terms[t].i) *
                                             std::pow(at[k].y() / reach, terms[t].j);
    }
    b[row] = weight * surface.axes.col(2).dot(points[k] - surface.origin);
  }
  const Eigen::VectorXd a = least_norm_solution(A, b).x;
  for (std::size_t t = 0; t < terms.size(); ++t)
    terms[t].a = a[static_cast<Eigen::Index>(t)] / std::pow(reach, terms[t].i + terms[t].j);
  surface.terms = std::move(terms);
  surface.outline = convex_outline(std::move(at));
}

}  // namespace condyle
