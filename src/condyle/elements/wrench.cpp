#include "condyle/elements/wrench.h"

namespace condyle {

Eigen::Matrix<double, 6, 1> scaled_wrench(const Wrench& w, double L) {
  Eigen::Matrix<double, 6, 1> scaled;
  scaled << w.f, w.m / L;
  return scaled;
}

Eigen::Matrix<double, 6, 6> scaled_stiffness(const Wrench& w, double L) {
  Eigen::Matrix<double, 6, 6> K;
  K << w.F1, w.F2 / L, w.M1 / L, w.M2 / (L * L);
  return -K;
}

}  // namespace condyle
