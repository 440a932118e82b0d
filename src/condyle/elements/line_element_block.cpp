#include "condyle/elements/line_element_block.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <variant>

#include "condyle/elements/surely_slack.h"
#include "condyle/math/no_number.h"
#include "condyle/math/simd.h"

namespace condyle {

/// With α = f' - f/L, β = f/L, e = d/L, u = q x e and x' = x_C - a, so that d = q - x':
///     F = -Σ β d                          M = Σ q x F = Σ β q x x'
///     ∂F/∂a = -Σ α e eᵀ - Σ β I           ∂F/∂π = -Σ α e uᵀ + [Σ β q]x,   ∂M/∂a its transpose
///     ∂M/∂π = -Σ α u uᵀ + Σ β (q x'ᵀ - (q.x') I)
/// Rows of the 3x3 sums, the fourth number of each idle.
struct LineElementBlock::Sums {
  double ee[3][4], eu[3][4], uu[3][4], qx[3][4], beta_q[4], beta_d[4];
  double beta, magnitudes;
  int zero_element;
};

namespace {

/// Force and slope, as tension() gives them.
struct Pull {
  double force, slope;
};

Pull general_pull(const ForceLaw& law, double length) {
  const Tension t = tension(law, length);
  return {t.force, t.slope};
}

Eigen::Matrix3d matrix_of(const double (*rows)[4]) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix(i, j) = rows[i][j];
  return matrix;
}

}  // namespace

void LineElementBlock::set(const std::vector<LineElement>& elements) {
  entries_.clear();
  entries_.reserve(elements.size());
  straight_.clear();
  curved_.clear();
  paths_.resize(path_numbers(elements));
  std::size_t numbers = 0;
  for (const LineElement& element : elements) {
    const auto index = static_cast<int>(&element - elements.data());
    if (element.path) {
      if (curved_.empty()) {
        straight_.resize(static_cast<std::size_t>(index));
        std::iota(straight_.begin(), straight_.end(), 0);
      }
      curved_.push_back({&element, index, numbers, false});
      numbers += static_cast<std::size_t>(element.path->numbers());
      continue;
    }
    if (!curved_.empty()) straight_.push_back(index);
    Entry entry{};
    for (int i = 0; i < 3; ++i) {
      entry.x_C[i] = element.x_C[i];
      entry.s_D[i] = element.s_D[i];
    }
    if (const auto* law = std::get_if<ToeLinearLaw>(&element.law)) {
      entry.stiffness = law->stiffness;
      entry.inverse_slack = 1 / law->slack_length;
      entry.transition_strain = law->transition_strain;
    } else {
      entry.law = &element.law;
    }
    entries_.push_back(entry);
  }
}

CONDYLE_FMA_CLONE
void LineElementBlock::add_entries(const std::vector<Entry>& entries,
                                   const RigidTransform& X_BA,
                                   Sums& sums) {
  const Four R0 = {X_BA.R(0, 0), X_BA.R(1, 0), X_BA.R(2, 0), 0};
  const Four R1 = {X_BA.R(0, 1), X_BA.R(1, 1), X_BA.R(2, 1), 0};
  const Four R2 = {X_BA.R(0, 2), X_BA.R(1, 2), X_BA.R(2, 2), 0};
  const Four a = {X_BA.p[0], X_BA.p[1], X_BA.p[2], 0};
  Four ee[3] = {}, eu[3] = {}, uu[3] = {}, qx[3] = {}, beta_q = {}, beta_d = {};
  double beta_sum = 0, magnitudes = 0;
  int zero_element = -1;
  for (const Entry& entry : entries) {
    const Four q = R0 * entry.s_D[0] + R1 * entry.s_D[1] + R2 * entry.s_D[2];
    const Four x = load_four(entry.x_C) - a;
    const Four d = q - x;
    const double L = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (!(L > kLeastLength)) {
      zero_element = static_cast<int>(&entry - entries.data());
      continue;
    }
    double force, slope;
    if (entry.law == nullptr) {
      const double strain = L * entry.inverse_slack - 1;
      if (!(strain > 0)) continue;
      const double stiff = entry.stiffness * entry.inverse_slack;
      if (strain >= entry.transition_strain) {
        force = entry.stiffness * (strain - 0.5 * entry.transition_strain);
        slope = stiff;
      } else {
        const double part = strain / entry.transition_strain;
        force = 0.5 * entry.stiffness * strain * part;
        slope = stiff * part;
      }
    } else {
      const Pull pull = general_pull(*entry.law, L);
      force = pull.force;
      slope = pull.slope;
      if (force == 0 && slope == 0) continue;
    }
    const double inverse = 1 / L, beta = force * inverse, alpha = slope - beta;
    const Four e = d * inverse;
    const Four u = {q[1] * e[2] - q[2] * e[1], q[2] * e[0] - q[0] * e[2], q[0] * e[1] - q[1] * e[0],
                    0};
    const Four alpha_e = alpha * e, alpha_u = alpha * u, b = beta * q;
    for (int i = 0; i < 3; ++i) {
      ee[i] += alpha_e[i] * e;
      eu[i] += alpha_e[i] * u;
      uu[i] += alpha_u[i] * u;
      qx[i] += b[i] * x;
    }
    beta_q += b;
    beta_d += beta * d;
    beta_sum += beta;
    magnitudes += std::abs(force);
  }
  for (int i = 0; i < 3; ++i) {
    store_four(sums.ee[i], ee[i]);
    store_four(sums.eu[i], eu[i]);
    store_four(sums.uu[i], uu[i]);
    store_four(sums.qx[i], qx[i]);
  }
  store_four(sums.beta_q, beta_q);
  store_four(sums.beta_d, beta_d);
  sums.beta = beta_sum;
  sums.magnitudes = magnitudes;
  sums.zero_element = zero_element;
}

void LineElementBlock::add_curved(const RigidTransform& X_BA,
                                  const std::vector<double>& kept,
                                  bool roughly,
                                  Wrench& wrench,
                                  Summary& summary) {
  if (summary.zero_element >= 0)
    summary.zero_element = straight_[static_cast<std::size_t>(summary.zero_element)];
  if (kept.size() == paths_.size())
    paths_ = kept;
  else
    std::fill(paths_.begin(), paths_.end(), kNoNumber);
  for (Curved& curved : curved_) {
    double* numbers = paths_.data() + curved.numbers;
    curved.passed_over = is_surely_slack(*curved.element, X_BA, numbers);
    if (curved.passed_over) continue;
    const LineElementState state =
        add_line_element(*curved.element, X_BA, wrench, numbers, roughly);
    summary.force_magnitudes += std::abs(state.force);
    if (!(state.length > kLeastLength)) summary.zero_element = curved.index;
  }
}

bool LineElementBlock::revise_paths(const RigidTransform& X_BA) {
  bool changed = false;
  for (const Curved& curved : curved_) {
    double* numbers = paths_.data() + curved.numbers;
    // One that was passed over here is followed now: how it lies is told, and it may have slipped.
    if (curved.passed_over) {
      const LineElementState state = line_element_state(*curved.element, X_BA, numbers);
      changed |= !(state.length > kLeastLength) || state.force != 0;
    }
    changed |= curved.element->path->revise(ends_of(*curved.element, X_BA), X_BA, numbers);
  }
  return changed;
}

LineElementBlock::Summary LineElementBlock::add_to(const RigidTransform& X_BA,
                                                   const std::vector<double>& kept,
                                                   Wrench& wrench,
                                                   bool roughly) {
  Sums sums;
  add_entries(entries_, X_BA, sums);
  const Eigen::Matrix3d qx = matrix_of(sums.qx);
  wrench.f -= Eigen::Vector3d(sums.beta_d[0], sums.beta_d[1], sums.beta_d[2]);
  wrench.m += Eigen::Vector3d(qx(1, 2) - qx(2, 1), qx(2, 0) - qx(0, 2), qx(0, 1) - qx(1, 0));
  wrench.F1 -= matrix_of(sums.ee);
  wrench.F1.diagonal().array() -= sums.beta;
  Eigen::Matrix3d F2 = -matrix_of(sums.eu);
  const double* b = sums.beta_q;
  // clang-format off
                      F2(0, 1) -= b[2];  F2(0, 2) += b[1];
  F2(1, 0) += b[2];                      F2(1, 2) -= b[0];
  F2(2, 0) -= b[1];  F2(2, 1) += b[0];
  // clang-format on
  wrench.F2 += F2;
  wrench.M1 += F2.transpose();
  wrench.M2 += qx - matrix_of(sums.uu);
  wrench.M2.diagonal().array() -= qx.trace();
  Summary summary{sums.magnitudes, sums.zero_element};
  if (has_paths()) add_curved(X_BA, kept, roughly, wrench, summary);
  return summary;
}

}  // namespace condyle
