#include "condyle/anatomy/lattice_field.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "condyle/input_error.h"
#include "condyle/surface/banded_cholesky.h"

namespace condyle {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::Vector4d;
using Weights = Eigen::Matrix<double, 64, 1>;

/// The four cubic B-splines over a cell of edge 1, and their derivatives by t.
Vector4d basis(double t) {
  const double s = 1 - t;
  return Vector4d(s * s * s, 3 * t * t * t - 6 * t * t + 4, 3 * s * s * s - 6 * s * s + 4,
                  t * t * t) /
         6;
}
Vector4d slope(double t) {
  const double s = 1 - t;
  return Vector4d(-s * s, 3 * t * t - 4 * t, -3 * s * s + 4 * s, t * t) / 2;
}
Vector4d curvature(double t) { return {1 - t, 3 * t - 2, 3 * (1 - t) - 2, t}; }

Weights product(const Vector4d& x, const Vector4d& y, const Vector4d& z) {
  Weights w;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) w.segment<4>(16 * i + 4 * j) = x[i] * y[j] * z;
  return w;
}

/// ∫ f fᵀ along a row of n - 3 cells of edge 1, exactly: f of degree 3 at most.
MatrixXd integrals(int n, Vector4d (*f)(double)) {
  // Gauss, four points on [0, 1].
  constexpr double kAt[] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                            0.9305681557970263};
  constexpr double kWeight[] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                0.1739274225687269};
  MatrixXd sum = MatrixXd::Zero(n, n);
  for (int cell = 0; cell + 3 < n; ++cell)
    for (int q = 0; q < 4; ++q) {
      const Vector4d v = f(kAt[q]);
      sum.block<4, 4>(cell, cell) += kWeight[q] * v * v.transpose();
    }
  return sum;
}

}  // namespace

LatticeField::LatticeField(const Vector3d& low, const Vector3d& high, double spacing)
    : spacing_(spacing), axis_{0, 1, 2} {
  const Vector3d size = high - low;
  std::sort(axis_.begin(), axis_.end(), [&](int a, int b) { return size[a] > size[b]; });
  for (int k = 0; k < 3; ++k) {
    const int cells = std::max(1, static_cast<int>(std::ceil(size[axis_[k]] / spacing)));
    n_[k] = cells + 3;
    low_[axis_[k]] = (low + high)[axis_[k]] / 2 - cells * spacing / 2;
  }
  c_.setZero(3, n_[0] * n_[1] * n_[2]);
}

LatticeField::Place LatticeField::place(const Vector3d& p) const {
  Place out;
  for (int k = 0; k < 3; ++k) {
    const double x = (p[axis_[k]] - low_[axis_[k]]) / spacing_;
    out.cell[k] = std::clamp(static_cast<int>(std::floor(x)), 0, n_[k] - 4);
    out.fraction[k] = x - out.cell[k];
  }
  return out;
}

Vector3d LatticeField::at(const Vector3d& p) const {
  const auto [cell, t] = place(p);
  const Vector4d x = basis(t[0]), y = basis(t[1]), z = basis(t[2]);
  Vector3d u = Vector3d::Zero();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      u += c_.middleCols<4>(node(cell[0] + i, cell[1] + j, cell[2])) * (x[i] * y[j] * z);
  return u;
}

Matrix3d LatticeField::gradient(const Vector3d& p) const {
  const auto [cell, t] = place(p);
  Matrix3d out = Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const Weights w =
        product(k == 0 ? slope(t[0]) : basis(t[0]), k == 1 ? slope(t[1]) : basis(t[1]),
                k == 2 ? slope(t[2]) : basis(t[2]));
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        out.col(axis_[k]) += c_.middleCols<4>(node(cell[0] + i, cell[1] + j, cell[2])) *
                             w.segment<4>(16 * i + 4 * j) / spacing_;
  }
  return out;
}

/// Node by node, lower half; the same for each component of the displacement.
MatrixXd LatticeField::bending_matrix(const FieldStiffness& stiffness) const {
  std::array<MatrixXd, 3> M, S, C;
  for (int k = 0; k < 3; ++k) {
    M[k] = integrals(n_[k], basis);
    S[k] = integrals(n_[k], slope);
    C[k] = integrals(n_[k], curvature);
  }
  const int n = static_cast<int>(c_.cols());
  const double cells = (n_[0] - 3.0) * (n_[1] - 3.0) * (n_[2] - 3.0);
  const double h2 = spacing_ * spacing_, bend = stiffness.bending / (h2 * h2 * cells),
               stretch = stiffness.bending / (h2 * cells * stiffness.reach * stiffness.reach);
  MatrixXd E = MatrixXd::Zero(n, n);
  const auto each = [](int i, int count, auto&& f) {
    for (int other = std::max(0, i - 3); other <= std::min(count - 1, i + 3); ++other) f(other);
  };
  for (int i = 0; i < n_[0]; ++i)
    for (int j = 0; j < n_[1]; ++j)
      for (int k = 0; k < n_[2]; ++k)
        each(i, n_[0], [&](int a) {
          each(j, n_[1], [&](int b) {
            each(k, n_[2], [&](int c) {
              if (node(a, b, c) > node(i, j, k)) return;
              const double mx = M[0](i, a), my = M[1](j, b), mz = M[2](k, c);
              const double sx = S[0](i, a), sy = S[1](j, b), sz = S[2](k, c);
              E(node(i, j, k), node(a, b, c)) =
                  bend * (C[0](i, a) * my * mz + mx * C[1](j, b) * mz + mx * my * C[2](k, c) +
                          2 * (sx * sy * mz + sx * my * sz + mx * sy * sz)) +
                  stretch * (sx * my * mz + mx * sy * mz + mx * my * sz);
            });
          });
        });
  return E;
}

void LatticeField::fit(const std::vector<PointPair>& pairs, const FieldStiffness& stiffness) {
  double sum = 0;
  std::map<std::array<int, 3>, std::vector<std::size_t>> by_cell;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!(pairs[i].weight > 0)) continue;
    by_cell[place(pairs[i].from).cell].push_back(i);
    sum += pairs[i].weight;
  }
  const int n = static_cast<int>(c_.cols());
  if (!(sum > 0)) return c_.setZero(), void();
  // A cubic B-spline meets those of three nodes on either side, along each axis.
  BandedMatrix A(3 * n, 3 * node(3, 3, 3) + 2);
  const MatrixXd E = bending_matrix(stiffness);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= i; ++j)
      if (E(i, j) != 0)
        for (int k = 0; k < 3; ++k) A.at(3 * i + k, 3 * j + k) = E(i, j);
  MatrixXd b = MatrixXd::Zero(3 * n, 1);
  for (const auto& [cell, members] : by_cell) {
    const int m = static_cast<int>(members.size());
    std::array<int, 64> nodes{};
    for (int a = 0; a < 64; ++a)
      nodes[a] = node(cell[0] + a / 16, cell[1] + a / 4 % 4, cell[2] + a % 4);
    Eigen::Matrix<double, 64, Eigen::Dynamic> W(64, m);
    std::vector<Matrix3d> metric(m);
    for (int q = 0; q < m; ++q) {
      const PointPair& pair = pairs[members[q]];
      const Vector3d t = place(pair.from).fraction;
      W.col(q) = product(basis(t[0]), basis(t[1]), basis(t[2]));
      const Matrix3d across = pair.normal * pair.normal.transpose();
      metric[q] = pair.weight / sum * (across + stiffness.along * (Matrix3d::Identity() - across));
      const Vector3d pull = metric[q] * (pair.to - pair.from);
      for (int a = 0; a < 64; ++a) b.middleRows<3>(3 * nodes[a]) += W(a, q) * pull;
    }
    Eigen::Matrix<double, 64, Eigen::Dynamic> scaled(64, m);
    Eigen::Matrix<double, 64, 64> G;
    for (int r = 0; r < 3; ++r)
      for (int s = 0; s <= r; ++s) {
        for (int q = 0; q < m; ++q) scaled.col(q) = metric[q](r, s) * W.col(q);
        G.triangularView<Eigen::Lower>() = scaled * W.transpose();
        for (int e = 0; e < 64; ++e)
          for (int a = e; a < 64; ++a) {
            A.at(3 * nodes[a] + r, 3 * nodes[e] + s) += G(a, e);
            if (r != s && a != e) A.at(3 * nodes[a] + s, 3 * nodes[e] + r) += G(a, e);
          }
      }
  }
  if (!A.factorize()) throw InputError("the template's bone cannot be laid over this one");
  A.solve(b);
  c_ = Eigen::Map<const MatrixXd>(b.data(), 3, n);
}

}  // namespace condyle
