#include "condyle/study/sobol_indices.h"

#include <Eigen/Core>
#include <cmath>

#include "condyle/math/no_number.h"

namespace condyle {

namespace {

constexpr double kNormal95 = 1.959963984540054;

/// Of the base points that are complete: a row each, columns A, B, AB_1 ... AB_d.
Eigen::ArrayXXd complete_rows(const double* y,
                              std::size_t points,
                              std::size_t blocks,
                              std::size_t stride) {
  std::vector<std::size_t> complete;
  for (std::size_t i = 0; i < points; ++i) {
    const double* row = y + i * blocks * stride;
    bool all = true;
    for (std::size_t j = 0; j < blocks; ++j) all = all && std::isfinite(row[j * stride]);
    if (all) complete.push_back(i);
  }
  Eigen::ArrayXXd rows(complete.size(), blocks);
  for (std::size_t i = 0; i < complete.size(); ++i) {
    const double* row = y + complete[i] * blocks * stride;
    for (std::size_t j = 0; j < blocks; ++j)
      rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = row[j * stride];
  }
  return rows;
}

/// mean(part)/mean(whole), and by the delta method its interval: the error of the ratio is the mean of
/// (part - ratio whole)/mean(whole), whose terms are independent.
IndexEstimate ratio_of_means(const Eigen::ArrayXd& part, const Eigen::ArrayXd& whole) {
  const auto n = static_cast<double>(part.size());
  const double of = whole.mean();
  const double ratio = part.mean() / of;
  const double squares = (part - ratio * whole).square().sum() / (of * of);
  const double half = kNormal95 * std::sqrt(squares / (n - 1) / n);
  return {ratio, ratio - half, ratio + half};
}

/// What two columns have in common and how far they spread, both about the mean of all [Monod].
struct Pair {
  Eigen::ArrayXd together, squares;
};

Pair pair_of(const Eigen::ArrayXd& y, const Eigen::ArrayXd& other) {
  const double mean = (y.mean() + other.mean()) / 2;
  const Eigen::ArrayXd c = y - mean, c_other = other - mean;
  return {c * c_other, (c.square() + c_other.square()) / 2};
}

/// cov(y_B, y_ABj)/var: these have parameter j in common and nothing else. y_A and y_B have nothing in
/// common: what they seem to have is chance, which y_ABj shares where j does little, and its part that
/// leaves the least spread is taken off (a control variate).
IndexEstimate first_order(const Eigen::ArrayXd& a,
                          const Eigen::ArrayXd& b,
                          const Eigen::ArrayXd& ab) {
  const Pair with_j = pair_of(b, ab);
  const Eigen::ArrayXd chance = pair_of(a, b).together;
  const double ratio = with_j.together.mean() / with_j.squares.mean();
  const Eigen::ArrayXd error = with_j.together - ratio * with_j.squares;
  const Eigen::ArrayXd about = chance - chance.mean();
  const double spread = about.square().sum();
  const double part = spread > 0 ? (error * about).sum() / spread : 0;
  return ratio_of_means(with_j.together - part * chance, with_j.squares);
}

/// y_A and y_ABj have all but parameter j in common.
IndexEstimate total(const Eigen::ArrayXd& a, const Eigen::ArrayXd& ab) {
  return ratio_of_means((a - ab).square() / 2, pair_of(a, ab).squares);
}

}  // namespace

SobolIndices sobol_indices(const double* y,
                           std::size_t points,
                           std::size_t parameters,
                           std::size_t stride) {
  const Eigen::ArrayXXd rows = complete_rows(y, points, parameters + 2, stride);
  const IndexEstimate none{kNoNumber, kNoNumber, kNoNumber};
  SobolIndices indices;
  indices.first.assign(parameters, none);
  indices.total.assign(parameters, none);
  indices.points = static_cast<long>(rows.rows());
  indices.mean = indices.variance = kNoNumber;
  if (rows.rows() == 0) return indices;

  const auto a = rows.col(0), b = rows.col(1);
  indices.mean = (a.mean() + b.mean()) / 2;
  indices.variance = ((a - indices.mean).square() + (b - indices.mean).square()).mean() / 2;
  const double largest = rows.leftCols(2).abs().maxCoeff();
  if (indices.points < 4 || !(std::sqrt(indices.variance) > kLeastDeviation * largest))
    return indices;
  for (std::size_t j = 0; j < parameters; ++j) {
    const auto ab = rows.col(static_cast<Eigen::Index>(j) + 2);
    indices.first[j] = first_order(a, b, ab);
    indices.total[j] = total(a, ab);
  }
  return indices;
}

}  // namespace condyle
