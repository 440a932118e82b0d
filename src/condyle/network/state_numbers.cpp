#include "condyle/network/state_numbers.h"

#include <Eigen/Geometry>

namespace condyle {
namespace {

constexpr std::size_t kPerBody = 13, kSums = 2;

using Three = Eigen::Map<Eigen::Vector3d>;
using ConstThree = Eigen::Map<const Eigen::Vector3d>;

Eigen::Quaterniond quaternion(const double* y) { return {y[3], y[4], y[5], y[6]}; }

void put(const Eigen::Quaterniond& q, double* y) {
  y[3] = q.w();
  Three(y + 4) = q.vec();
}

/// dq where the body turns by θ: ½ θ q.
Eigen::Quaterniond half_turned(const Eigen::Vector3d& theta, const Eigen::Quaterniond& q) {
  Eigen::Quaterniond dq = Eigen::Quaterniond(0, theta[0], theta[1], theta[2]) * q;
  dq.coeffs() /= 2;
  return dq;
}

}  // namespace

std::size_t StateNumbers::size() const { return kPerBody * network_.bodies.size() + kSums; }

std::vector<double> StateNumbers::scales() const {
  const double length = network_.length / 3, speed = 10 * length;
  const double scale[kPerBody] = {length, length, length, 1, 1, 1, 1, speed, speed, speed, 1, 1, 1};
  const double energy = 10 * length;  // of newtons over a length
  std::vector<double> scales;
  for (std::size_t b = 0; b < network_.bodies.size(); ++b)
    scales.insert(scales.end(), scale, scale + kPerBody);
  scales.insert(scales.end(), kSums, energy);
  return scales;
}

void StateNumbers::pack(const NetworkState& state,
                        double dissipated,
                        double work,
                        double* y) const {
  for (std::size_t b = 0; b < state.bodies.size(); ++b, y += kPerBody) {
    const BodyState& body = state.bodies[b];
    Three{y} = body.X * network_.bodies[b].reference;
    put(Eigen::Quaterniond(body.X.R), y);
    Three(y + 7) = body.v;
    Three(y + 10) = body.omega;
  }
  y[0] = dissipated;
  y[1] = work;
}

void StateNumbers::unpack(const double* y, NetworkState& state) const {
  for (std::size_t b = 0; b < state.bodies.size(); ++b, y += kPerBody) {
    BodyState& body = state.bodies[b];
    body.X.R = quaternion(y).normalized().toRotationMatrix();
    body.X.p = ConstThree(y) - body.X.R * network_.bodies[b].reference;
    body.v = ConstThree(y + 7);
    body.omega = ConstThree(y + 10);
  }
}

void StateNumbers::rates(const double* y, const NetworkEquations& equations, double* rate) const {
  for (std::size_t b = 0; b < network_.bodies.size(); ++b, y += kPerBody, rate += kPerBody) {
    Three{rate} = ConstThree(y + 7);
    put(half_turned(ConstThree(y + 10), quaternion(y)), rate);
    Eigen::Map<Vector6>(rate + 7) =
        equations.accelerations().segment<6>(static_cast<Eigen::Index>(6 * b));
  }
  rate[0] = 0;
  for (const LineState& line : equations.lines()) rate[0] += line.dissipation;
  rate[1] = equations.driver_power();
}

void StateNumbers::difference(const NetworkState& state, const double* y, double* change) const {
  for (std::size_t b = 0; b < state.bodies.size(); ++b, y += kPerBody, change += kPerBody) {
    const BodyState& body = state.bodies[b];
    Eigen::Quaterniond q(body.X.R);
    const Eigen::Quaterniond before = quaternion(y);
    if (q.dot(before) < 0) q.coeffs() = -q.coeffs();
    q.coeffs() -= before.coeffs();
    Three{change} = body.X * network_.bodies[b].reference - ConstThree(y);
    put(q, change);
    Three(change + 7) = body.v - ConstThree(y + 7);
    Three(change + 10) = body.omega - ConstThree(y + 10);
  }
  change[0] = change[1] = 0;
}

void StateNumbers::keep_admissible(const double* y,
                                   const NetworkEquations& equations,
                                   double* error) const {
  const std::size_t bodies = network_.bodies.size();
  Eigen::VectorXd motion(static_cast<Eigen::Index>(6 * bodies)), change = motion;
  for (std::size_t b = 0; b < bodies; ++b) {
    const double* e = error + kPerBody * b;
    const auto row = static_cast<Eigen::Index>(6 * b);
    const Eigen::Quaterniond q = quaternion(y + kPerBody * b);
    motion.segment<6>(row) << ConstThree(e), 2 * (quaternion(e) * q.conjugate()).vec();
    change.segment<6>(row) = Eigen::Map<const Vector6>(e + 7);
  }
  equations.keep_admissible(motion, change);
  for (std::size_t b = 0; b < bodies; ++b) {
    double* e = error + kPerBody * b;
    const auto row = static_cast<Eigen::Index>(6 * b);
    Three{e} = motion.segment<3>(row);
    put(half_turned(motion.segment<3>(row + 3), quaternion(y + kPerBody * b)), e);
    Eigen::Map<Vector6>(e + 7) = change.segment<6>(row);
  }
}

}  // namespace condyle
