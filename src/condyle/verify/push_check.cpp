#include "condyle/verify/push_check.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>
#include <random>

#include "condyle/verify/coordinates.h"
#include "condyle/verify/laws.h"
#include "condyle/verify/layer_checks.h"

namespace condyle::verification {
namespace {

constexpr double kPush = 0.02;       ///< [mm], rotations at an arm of kArm
constexpr double kLeastPush = 1e-4;  ///< and of one that is tried where such a push is not small
constexpr double kArm = 30;          ///< [mm]
constexpr double kFarthest = 0.5;    ///< [mm] that no push makes a ligament longer by
constexpr int kDirections = 16;      ///< a pose
constexpr int kCorrections = 6;

double straight_length(const Scene& scene,
                       const LigamentDescription& ligament,
                       const RigidTransform& X) {
  return (in_ground(scene, ligament.ends[0], X) - in_ground(scene, ligament.ends[1], X)).norm();
}

struct Nearest {
  double gap;
  Vector3d point, n;  ///< on the fixed side, ground frame
};

/// The local minimum of the gap near a point of the moving side: Newton along its tangent plane.
Nearest nearest(const PairOfSides& pair, const RigidTransform& X, Vector3d p) {
  constexpr double kStep = 1e-4;  // [mm]
  ClosestPoint on_B = pair.fixed->closest(X * p);
  for (int i = 0; i < 12; ++i) {
    const ClosestPoint on_A = pair.moving->closest(p);
    Eigen::Matrix<double, 3, 2> T;
    T.col(0) = on_A.n.unitOrthogonal();
    T.col(1) = on_A.n.cross(T.col(0));
    const auto slope = [&](const Vector3d& at) -> Eigen::Vector2d {
      const ClosestPoint own = pair.moving->closest(at);
      Vector3d n = X.R.transpose() * pair.fixed->closest(X * own.point).n;
      n -= n.dot(own.n) * own.n;
      return T.transpose() * n;
    };
    const Eigen::Vector2d g = slope(p);
    Eigen::Matrix2d H;
    H.col(0) = (slope(p + kStep * T.col(0)) - g) / kStep;
    H.col(1) = (slope(p + kStep * T.col(1)) - g) / kStep;
    if (std::abs(H.determinant()) < 1e-14) break;
    Eigen::Vector2d step = -H.inverse() * g;
    if (step.norm() > 1) step.normalize();
    p = pair.moving->closest(p + T * step).point;
    on_B = pair.fixed->closest(X * p);
    if (step.norm() < 1e-10) break;
  }
  return {on_B.distance, on_B.point, on_B.n};
}

}  // namespace

PushCheck::PushCheck(const Subject& subject) : subject_(subject) {}

std::vector<PushCheck::Constraint> PushCheck::constraints(const PoseResult& pose,
                                                          const RigidTransform& X) const {
  const Scene& scene = subject_.run.scene;
  std::vector<Constraint> list;
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    if (!pose.contacts[i].closed || pose.contacts[i].layer) continue;
    for (const ContactPointResult& point : pose.contacts[i].points) {
      const Nearest now = nearest(pair_of(subject_, i), X, point.point_moving);
      Constraint c{now.gap, {}};
      c.gradient << now.n, (now.point - X.p).cross(now.n);
      list.push_back(c);
    }
  }
  for (std::size_t i = 0; i < scene.conditions.size(); ++i) {
    const ConditionDescription& condition = scene.conditions[i];
    list.push_back(
        {difference(condition, coordinate(scene, condition, X), prescribed(subject_, i, pose)),
         gradient(scene, condition, X, X.p)});
  }
  return list;
}

/// One that wraps and is slack, however it is pushed, needs no string; a length that is not found is
/// no number.
std::vector<PushCheck::Line> PushCheck::lines(const PoseResult& pose) const {
  const Scene& scene = subject_.run.scene;
  std::vector<Line> lines(scene.ligaments.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const LigamentDescription& ligament = scene.ligaments[i];
    lines[i].length = pose.ligaments[i].length;
    if (ligament.path.wraps.empty()) {
      lines[i].length = straight_length(scene, ligament, pose.X_BA);
      continue;
    }
    const auto pulls = [&](double more) {
      return force_at(ligament.law, lines[i].length + more) != 0;
    };
    if (!pulls(-kFarthest) && !pulls(0) && !pulls(kFarthest)) continue;
    lines[i].string.emplace(scene, pose, i);
    lines[i].length = lines[i].string->pulled_to(pose.X_BA).value_or(std::nan(""));
  }
  return lines;
}

/// Energy that ligaments and layers gain, less the work of loads, on a short way from the pose
/// [N mm].
double PushCheck::work(const PoseResult& pose,
                       std::vector<Line>& lines,
                       const RigidTransform& to) const {
  const Scene& scene = subject_.run.scene;
  const RigidTransform& from = pose.X_BA;
  double sum = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const LigamentDescription& ligament = scene.ligaments[i];
    if (!ligament.path.wraps.empty() && !lines[i].string) continue;
    const double length = lines[i].string ? lines[i].string->pulled_to(to).value_or(std::nan(""))
                                          : straight_length(scene, ligament, to);
    sum += work_between(ligament.law, lines[i].length, length);
  }
  sum += layer_energy(subject_, pose, to) - layer_energy(subject_, pose, from);
  const Eigen::AngleAxisd turned(Eigen::Matrix3d(to.R * from.R.transpose()));
  const Vector3d theta = turned.angle() * turned.axis();
  const Eigen::Matrix3d half = turn(theta / 2) * from.R;
  for (std::size_t i = 0; i < scene.loads.size(); ++i) {
    const LoadDescription& load = scene.loads[i];
    Vector3d vector = load_scale(subject_, i, pose) * load.vector;
    if (load.follows_body) vector = half * vector;
    sum -= vector.dot(load.moment ? theta : Vector3d(to * load.at - from * load.at));
  }
  return sum;
}

void PushCheck::not_tried(Ledger& ledger) {
  ledger.warn("pushes", 0,
              fmt::format("{}: energy under pushes is not checked: a ligament that wraps does not "
                          "settle on the surfaces that it is told to touch",
                          ledger.pose_name()));
}

/// The step that is nearest to the wanted one and meets the constraints, corrected until it does;
/// `length` of it as it was taken first.
RigidTransform PushCheck::pushed(const PoseResult& pose, Vector6 step, double& length) const {
  Vector6 scale;
  scale << 1, 1, 1, 1 / kArm, 1 / kArm, 1 / kArm;
  RigidTransform X = pose.X_BA;
  for (int i = 0; i <= kCorrections; ++i) {
    const std::vector<Constraint> list = constraints(pose, X);
    Eigen::MatrixXd G(list.size(), 6);
    Eigen::VectorXd value(list.size());
    for (std::size_t c = 0; c < list.size(); ++c) {
      G.row(static_cast<Eigen::Index>(c)) = list[c].gradient.cwiseProduct(scale).transpose();
      value[static_cast<Eigen::Index>(c)] = list[c].value;
    }
    Vector6 taken = step;
    if (!list.empty()) taken -= G.completeOrthogonalDecomposition().solve(G * step + value);
    if (i == 0) length = taken.norm();
    taken = taken.cwiseProduct(scale);
    X = moved(X, taken.head<3>(), taken.tail<3>(), X.p);
    step.setZero();
  }
  return X;
}

/// The most that a push of that size lowers the energy by [N/mm]; NaN where it cannot be told.
double PushCheck::lowers(const PoseResult& pose, std::vector<Line>& lines, double size) const {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  double worst = 0;
  for (int k = 0; k < kDirections; ++k) {
    Vector6 push;
    for (double& x : push) x = normal(random);
    push = push.normalized() * size;
    double gained = 0, length = 0;
    for (const double sign : {1.0, -1.0})
      gained += work(pose, lines, pushed(pose, sign * push, length));
    if (std::isnan(gained)) return gained;
    if (length > 1e-3 * size) worst = std::max(worst, -gained / (length * length));
  }
  return worst;
}

void PushCheck::check(const PoseResult& pose, Ledger& ledger) const {
  if (pose.stability != 1) return;
  for (const ContactResult& contact : pose.contacts)
    if (contact.closed && contact.shape != ContactShape::kPoint) return;
  std::vector<Line> lines = this->lines(pose);
  // Where surfaces nearly conform a push is small only if it is smaller than what their radii differ by.
  double worst = INFINITY;
  for (double size = kPush; size >= kLeastPush && worst > ledger.allowed(Check::kStability);
       size /= 10) {
    const double found = lowers(pose, lines, size);
    if (std::isnan(found)) break;
    worst = std::min(worst, found);
  }
  if (std::isinf(worst)) return not_tried(ledger);
  ledger.note(
      Check::kStability, worst, "",
      fmt::format("is called stable, but a small push lowers the energy by {:.3g} N/mm", worst));
}

}  // namespace condyle::verification
