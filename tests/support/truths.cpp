#include "support/truths.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "condyle/math/rotation.h"

namespace condyle::hard {
namespace {

using Eigen::Vector3d;

constexpr double kWrong = std::numeric_limits<double>::infinity();

/// Keeps the largest error; a number that is none counts as wrong.
class Worst {
 public:
  void take(double error) { worst_ = std::isnan(error) ? kWrong : std::max(worst_, error); }
  void take(double computed, double exact, double size) { take(std::abs(computed - exact) / size); }
  void take(const Vector3d& computed, const Vector3d& exact, double size) {
    take((computed - exact).norm() / size);
  }
  void require(bool fact) { take(fact ? 0 : kWrong); }
  [[nodiscard]] double value() const { return worst_; }

 private:
  double worst_ = 0;
};

/// Calls for each pose that converged.
template <class Check>
double over(const SweepResult& sweep, const Check& check) {
  Worst worst;
  for (const PoseResult& pose : sweep.poses)
    if (pose.converged()) check(pose, worst);
  return worst.value();
}

double event_error(const SweepResult& sweep, EventKind kind, double value) {
  double least = kWrong;
  for (const Event& event : sweep.events)
    if (event.kind == kind) least = std::min(least, std::abs(event.value - value));
  return least;
}

}  // namespace

double ball_in_cup(const SweepResult& sweep, double R, double r) {
  return over(sweep, [=](const PoseResult& pose, Worst& worst) {
    const Vector3d F(pose.value, 0, -50), along = F.normalized();
    worst.take(pose.X_BA.p, (R - r) * along, R);
    worst.take(pose.X_BA.R * -Vector3d::UnitZ(), along, 1);
    worst.take(pose.contacts[0].force, F.norm(), F.norm());
  });
}

double guided_ball(const SweepResult& sweep) {
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    worst.take(pose.X_BA.p, Vector3d(1, 0, 10), 10);
  });
}

double held_ball(const SweepResult& sweep) {
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    worst.take(pose.X_BA.p, Vector3d(0, 0, 10), 10);
    const double floor = pose.contacts[0].force, guide = pose.conditions[0].multiplier;
    worst.take(floor + std::abs(guide), 10 * pose.value, 10);
  });
}

double roller(const SweepResult& sweep) {
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    worst.take(pose.X_BA.p, Vector3d(0, pose.value, 5), 20);
    const ContactResult& line = pose.contacts[0];
    worst.require(line.shape == ContactShape::kLine && line.points.size() == 2);
    for (const ContactPointResult& end : line.points) {
      worst.take(std::abs(end.point_ground.x()), 20, 20);
      worst.take(end.force, 20 + std::copysign(7, end.point_ground.x()), 40);
    }
  });
}

double rolling_stone(const SweepResult& sweep) {
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    const double w = pose.value, height = std::hypot(8 * std::sin(w), 5 * std::cos(w));
    worst.take(pose.X_BA.p, Vector3d(0, 0, height), 8);
    worst.take(pose.contacts[0].force, 10, 10);
  });
}

double ball_over_ridges(const SweepResult& sweep) {
  // The least distance of the floor from the ball's centre, by Newton on its derivative from a
  // scan.
  const auto distance = [](const PoseResult& pose) {
    const double cx = pose.X_BA.p.x(), cz = pose.X_BA.p.z();
    const auto z = [](double x) { return 0.02 * x * x - 1e-4 * x * x * x * x; };
    double best = 0, least = kWrong;
    for (double x = -25; x <= 25; x += 0.01) {
      const double d = std::hypot(x - cx, z(x) - cz);
      if (d < least) least = d, best = x;
    }
    for (int k = 0; k < 20; ++k) {
      const double slope = 0.04 * best - 4e-4 * best * best * best;
      const double bend = 0.04 - 12e-4 * best * best;
      const double f = best - cx + (z(best) - cz) * slope;
      best -= f / (1 + slope * slope + (z(best) - cz) * bend);
    }
    return std::hypot(best - cx, z(best) - cz);
  };
  const double touching = over(
      sweep, [&](const PoseResult& pose, Worst& worst) { worst.take(distance(pose), 60, 60); });
  return std::max(touching, event_error(sweep, EventKind::kJump, 0));
}

double dumbbell(const SweepResult& sweep) {
  const double standing = over(sweep, [](const PoseResult& pose, Worst& worst) {
    worst.take(pose.X_BA.p, Vector3d(0, 0, 4 + 10 * std::abs(std::sin(pose.value))), 10);
    worst.take(pose.contacts[pose.value > 0 ? 1 : 0].force, 10, 10);
    worst.require(!pose.contacts[pose.value > 0 ? 0 : 1].closed);
  });
  return std::max({standing, event_error(sweep, EventKind::kClosing, 0),
                   event_error(sweep, EventKind::kOpening, 0)});
}

double sledge(const SweepResult& sweep) {
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    worst.take(pose.X_BA.p, Vector3d(pose.value, 0, 6 * std::sqrt(2)), 15);
    worst.take((pose.X_BA.R - Eigen::Matrix3d::Identity()).norm());
    for (const ContactResult& contact : pose.contacts)
      worst.take(contact.force, 100 / std::sqrt(8), 100);
  });
}

double hooked_ball(const SweepResult& sweep) {
  // The hook is stretched to 25 mm: 500 (0.25 - 0.03) N.
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    worst.take(pose.X_BA.p, Vector3d(0, 0, 10), 10);
    worst.take((pose.X_BA.R - Eigen::Matrix3d::Identity()).norm());
    worst.take(pose.contacts[0].force, 110, 110);
  });
}

double ball_on_dome(const SweepResult& sweep) {
  // The normal at x leans by 0.02 x: the centre is at x + 5 sin(atan 0.02 x), the force 10/cos.
  const double on_dome = over(sweep, [](const PoseResult& pose, Worst& worst) {
    const double x = pose.contacts[0].points[0].point_ground.x(), lean = std::atan(0.02 * x);
    worst.take(pose.X_BA.p, Vector3d(x + 5 * std::sin(lean), 0, -0.01 * x * x + 5 * std::cos(lean)),
               10);
    worst.take(pose.contacts[0].force, 10 / std::cos(lean), 10);
  });
  return std::max(on_dome,
                  event_error(sweep, EventKind::kLeavingPatch, 10 + 5 * std::sin(std::atan(0.2))));
}

double ball_in_pits(const SweepResult& sweep) {
  Worst worst;
  const double pits[] = {1, 1, 1, 1, 1, -1, -1, -1};
  for (std::size_t i = 0; i < sweep.poses.size(); ++i) {
    const PoseResult& pose = sweep.poses[i];
    const Vector3d c = pose.contacts[0].points.at(0).point_ground;
    worst.require(c.x() * pits[i] > 0);
    // Where the floor leans as the resultant asks.
    worst.take(-0.04 * c.x() + 4e-4 * c.x() * c.x() * c.x(), pose.value / 50, 1);
    worst.take(pose.contacts[0].force, std::hypot(50, pose.value), 50);
  }
  // The steepest place between the pits, at x = 10/sqrt 3.
  const double x = 10 / std::sqrt(3);
  worst.take(1e-1 *
             event_error(sweep, EventKind::kLimitPoint, 50 * (-0.04 * x + 4e-4 * x * x * x)));
  return worst.value();
}

double slack_bone(const SweepResult& sweep) {
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    worst.take(pose.X_BA.p, Vector3d(1, 2, 3), 10);
    worst.take((pose.X_BA.R - exp_rotation({pose.value, 0, 0})).norm());
    worst.require(pose.stability == 0);
  });
}

double hanging_weight(const SweepResult& sweep) {
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    const double F = pose.value;
    const double strain = F <= 30 ? std::sqrt(2 * F * 0.06 / 1000) : F / 1000 + 0.03;
    worst.take(pose.X_BA.p, Vector3d(0, 0, -20 * (1 + strain)), 20);
    worst.take(pose.ligaments[0].force, F, F);
  });
}

double short_spring(const SweepResult& sweep) {
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    worst.take(pose.ligaments[0].length, pose.value, 1);
    worst.take(std::abs(pose.conditions[0].multiplier), 5 + 10 * pose.value, 5);
  });
}

double block_between_walls(const SweepResult& sweep) {
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    worst.take(pose.X_BA.p, Vector3d(pose.value / (1e9 + 1), 0, 0), 10);
  });
}

namespace {

const double kTrussLength = std::sqrt(125.0);
const double kTrussLimit = [] {
  const double L = std::cbrt(100 * kTrussLength), z = std::sqrt(L * L - 100);
  return 40 * z * (kTrussLength / L - 1);
}();

double truss_load(double z) { return 40 * z * (kTrussLength / std::hypot(10, z) - 1); }

}  // namespace

double snapping_truss(const SweepResult& sweep) {
  const double standing = over(sweep, [](const PoseResult& pose, Worst& worst) {
    const double z = pose.X_BA.p.z();
    worst.take(truss_load(z), pose.value, 10);
    worst.require((z > 0) == (pose.value < kTrussLimit));
  });
  // As near as a bracket comes: where the tangent turns, the pose is known to the root of
  // round-off.
  return std::max(standing, event_error(sweep, EventKind::kLimitPoint, kTrussLimit));
}

double path_of_truss(const SweepResult& sweep) {
  bool rising = false, falling = false, hanging = false;
  const double on_path = over(sweep, [&](const PoseResult& pose, Worst& worst) {
    const double z = pose.X_BA.p.z(), turn = std::sqrt(std::cbrt(1e4 * 125) - 100);
    worst.take(truss_load(z), pose.value, 10);
    rising |= z > turn;
    falling |= std::abs(z) < turn;
    hanging |= z < -turn;
    worst.require(pose.stability == (std::abs(z) > turn ? 1 : 0));
  });
  if (!rising || !falling || !hanging) return kWrong;
  return std::max(on_path, event_error(sweep, EventKind::kLimitPoint, kTrussLimit));
}

double column(const SweepResult& sweep) {
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    worst.take(pose.X_BA.p.norm() / 40);
    worst.take((pose.X_BA.R - Eigen::Matrix3d::Identity()).norm());
    worst.require(pose.stability == (pose.value < 160 ? 1 : 0));
  });
}

double bob(const SweepResult& sweep) {
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    worst.take(pose.X_BA.p, Vector3d(0, 0, -30), 30);
    worst.take(std::abs(pose.conditions[0].multiplier), 10 * std::abs(pose.value), 10);
    worst.require(pose.stability == (pose.value < 0 ? 1 : 0));
  });
}

double swinging_bob(const SweepResult& sweep) {
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    const Vector3d load(0.01, 0, 10 * pose.value);
    worst.take(pose.X_BA.p, 30 * load.normalized(), 30);
    worst.take(std::abs(pose.conditions[0].multiplier), load.norm(), 10);
    worst.require(pose.stability == 1);
  });
}

double wheel(const SweepResult& sweep) {
  // The spring's end turns in a circle of 10 about the origin, 30 under the other one.
  return over(sweep, [](const PoseResult& pose, Worst& worst) {
    worst.take(pose.ligaments[0].length, std::sqrt(1000 - 600 * std::sin(pose.value)), 30);
    worst.take(pose.conditions[3].value, pose.value, 1);
  });
}

}  // namespace condyle::hard
