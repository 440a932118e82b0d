#include "condyle/surface/bspline_basis.h"

#include <algorithm>
#include <cassert>

namespace condyle {

int find_span(const std::vector<double>& knots, int degree, double t) {
  const int n = static_cast<int>(knots.size()) - degree - 1;
  const auto first = knots.begin() + degree;
  const auto last = knots.begin() + n;
  const auto above = std::upper_bound(first, last, t);
  return std::clamp(static_cast<int>(above - knots.begin()) - 1, degree, n - 1);
}

BasisValues basis(const std::vector<double>& knots, int degree, double t, int order) {
  assert(degree >= 1 && degree <= kMaxDegree && order >= 0 && order <= 3);
  const int span = find_span(knots, degree, t);
  const int p = degree;

  // ndu: basis functions of every degree in the upper triangle, knot differences in the lower one
  // [Piegl and Tiller 1997, A2.3].
  double ndu[kMaxDegree + 1][kMaxDegree + 1];
  double left[kMaxDegree + 1], right[kMaxDegree + 1];
  ndu[0][0] = 1;
  for (int j = 1; j <= p; ++j) {
    left[j] = t - knots[span + 1 - j];
    right[j] = knots[span + j] - t;
    double saved = 0;
    for (int r = 0; r < j; ++r) {
      ndu[j][r] = right[r + 1] + left[j - r];
      const double term = ndu[r][j - 1] / ndu[j][r];
      ndu[r][j] = saved + right[r + 1] * term;
      saved = left[j - r] * term;
    }
    ndu[j][j] = saved;
  }

  BasisValues values;
  values.first = span - p;
  for (int j = 0; j <= p; ++j) values.d[0][j] = ndu[j][p];

  const int highest = std::min(order, p);
  for (int r = 0; r <= p; ++r) {
    double a[2][kMaxDegree + 1] = {{1}};
    int now = 0, next = 1;
    for (int k = 1; k <= highest; ++k) {
      const int rk = r - k, pk = p - k;
      double sum = 0;
      if (r >= k) {
        a[next][0] = a[now][0] / ndu[pk + 1][rk];
        sum = a[next][0] * ndu[rk][pk];
      }
      const int j1 = rk >= -1 ? 1 : -rk;
      const int j2 = r - 1 <= pk ? k - 1 : p - r;
      for (int j = j1; j <= j2; ++j) {
        a[next][j] = (a[now][j] - a[now][j - 1]) / ndu[pk + 1][rk + j];
        sum += a[next][j] * ndu[rk + j][pk];
      }
      if (r <= pk) {
        a[next][k] = -a[now][k - 1] / ndu[pk + 1][r];
        sum += a[next][k] * ndu[r][pk];
      }
      values.d[k][r] = sum;
      std::swap(now, next);
    }
  }
  double factor = p;
  for (int k = 1; k <= highest; ++k) {
    for (int j = 0; j <= p; ++j) values.d[k][j] *= factor;
    factor *= p - k;
  }
  return values;
}

std::vector<double> uniform_knots(int n, int degree, double a, double b) {
  assert(n > degree && b > a);
  const double h = (b - a) / (n - degree);
  std::vector<double> knots(n + degree + 1);
  for (int i = 0; i < static_cast<int>(knots.size()); ++i) knots[i] = a + (i - degree) * h;
  knots[n] = b;  // the domain ends exactly there
  return knots;
}

}  // namespace condyle
