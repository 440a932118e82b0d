#include "condyle/equilibrium/motion_name.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>

#include "condyle/math/decompositions.h"
#include "condyle/math/rotation.h"

namespace condyle {
namespace {

constexpr double kComparable = 0.5;  // of the largest share
constexpr double kNothing = 1e-6;    // a share that is round-off

constexpr std::array<const char*, 6> kCoordinates = {
    "flexion", "adduction", "internal rotation", "lateral shift", "anterior drawer", "distraction"};

/// Angles as L q, so that all shares are lengths.
Eigen::Matrix<double, 6, 1> scaled_coordinates(const JointFrames& frames,
                                               const RigidTransform& X,
                                               double L) {
  const JointCoordinates q = joint_coordinates(frames, X);
  Eigen::Matrix<double, 6, 1> scaled;
  scaled << L * q.flexion, L * q.adduction, L * q.internal_rotation, q.lateral_shift,
      q.anterior_drawer, q.distraction;
  return scaled;
}

/// How the joint coordinates change with each motion: one column each.
Motions joint_shares(const Model& model, const RigidTransform& X, const Motions& motions) {
  constexpr double kStep = 1e-5;  // [rad], and of L
  const double L = model.length, turn = 2 * M_PI * L;
  Motions shares(6, motions.cols());
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    const auto at = [&](double h) {
      const Eigen::Vector3d da = h * L * motions.col(k).head<3>();
      const Eigen::Vector3d dpi = h * motions.col(k).tail<3>();
      return scaled_coordinates(*model.joint, {exp_rotation(dpi) * X.R, X.p + da}, L);
    };
    shares.col(k) = at(kStep) - at(-kStep);
    for (int i = 0; i < 3; ++i) shares(i, k) = std::remainder(shares(i, k), turn);
  }
  return shares / (2 * kStep * L);
}

std::string name_by_joint(const Model& model, const RigidTransform& X, const Motions& motions) {
  const Motions shares = joint_shares(model, X, motions);
  const PivotedBasis basis = pivoted_basis(shares.transpose(), 0);
  std::vector<bool> chosen(6, false);
  for (std::size_t k = 0; k < static_cast<std::size_t>(motions.cols()); ++k)
    chosen[static_cast<std::size_t>(basis.order[k])] = true;
  if (motions.cols() == 1) {
    const double largest = shares.col(0).cwiseAbs().maxCoeff();
    int second = -1;
    for (int i = 0; i < 6; ++i) {
      if (chosen[static_cast<std::size_t>(i)] || std::abs(shares(i, 0)) < kComparable * largest)
        continue;
      if (second < 0 || std::abs(shares(i, 0)) > std::abs(shares(second, 0))) second = i;
    }
    if (second >= 0) chosen[static_cast<std::size_t>(second)] = true;
  }
  std::vector<std::string> words;
  for (std::size_t i = 0; i < 6; ++i)
    if (chosen[i]) words.emplace_back(kCoordinates[i]);
  return joined(words);
}

/// Combines the motions so that each has a component which the others lack: free motions along
/// simple directions come out as such.
Motions reduced(Motions motions) {
  for (Eigen::Index k = 0; k < motions.cols(); ++k) {
    Eigen::Index row = 0, column = 0;
    motions.rightCols(motions.cols() - k).cwiseAbs().maxCoeff(&row, &column);
    motions.col(k).swap(motions.col(k + column));
    motions.col(k) /= motions(row, k);
    for (Eigen::Index j = 0; j < motions.cols(); ++j)
      if (j != k) motions.col(j) -= motions(row, j) * motions.col(k);
  }
  for (Eigen::Index k = 0; k < motions.cols(); ++k) motions.col(k).normalize();
  return motions;
}

std::string in_words(const Eigen::Vector3d& v) {
  const auto tidy = [](double x) { return std::abs(x) < 0.005 ? 0.0 : x; };
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", tidy(v.x()), tidy(v.y()), tidy(v.z()));
}

/// Of the two directions along a line the one whose first component of at least half the greatest is positive: an eigenvector
/// may come out either way.
Eigen::Vector3d directed(const Eigen::Vector3d& v) {
  const double least = v.cwiseAbs().maxCoeff() / 2;
  for (const double x : v)
    if (std::abs(x) >= least) return x < 0 ? Eigen::Vector3d(-v) : v;
  return v;
}

/// The motion of a point of A at `at` (ground frame of the files) as a screw about an axis: a
/// rotation, a translation, or both.
std::string name_screw(const Eigen::Matrix<double, 6, 1>& motion,
                       const Eigen::Vector3d& at,
                       double L) {
  const Eigen::Vector3d v = motion.head<3>(), omega = motion.tail<3>() / L;
  if (omega.norm() * L < kNothing)
    return "a translation along " + in_words(directed(v.normalized()));
  const double square = omega.squaredNorm(), pitch = omega.dot(v) / square;
  const Eigen::Vector3d through = at + omega.cross(v) / square;
  std::string words = "a rotation about " + in_words(directed(omega.normalized())) + " through " +
                      in_words(through) + " mm";
  if (std::abs(pitch) > kNothing * L)
    words += fmt::format(" with {:.2f} mm along it per degree", pitch * M_PI / 180);
  return words;
}

}  // namespace

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) all += i + 1 == words.size() ? " and " : ", ";
    all += words[i];
  }
  return all;
}

std::string name_motions(const Model& model, const RigidTransform& X_BA, const Motions& motions) {
  if (motions.cols() == 6) return "any motion";
  if (model.joint) return name_by_joint(model, X_BA, motions);
  const Motions simple = motions.cols() > 1 ? reduced(motions) : motions;
  std::vector<std::string> words;
  for (Eigen::Index k = 0; k < simple.cols(); ++k)
    words.push_back(name_screw(simple.col(k), X_BA.p + model.origins.B, model.length));
  return joined(words);
}

}  // namespace condyle
