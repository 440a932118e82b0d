#include "condyle/results/contact_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "condyle/results/run_view.h"

namespace condyle {
namespace {

constexpr double kShortStep = 3;    // [mm]: the dots of a path touch, a line hides nothing
constexpr double kFarStep = 25;     // [mm]: another contact, whatever lies around
constexpr double kFaster = 4;       // than the steps around it
constexpr std::size_t kAround = 2;  // steps to either side

using Piece = std::vector<std::size_t>;

const ContactPointResult* place_of(const SweepResult& sweep, std::size_t pose, std::size_t c) {
  const PoseResult& result = sweep.poses[pose];
  if (!result.converged() || c >= result.contacts.size() || !result.contacts[c].closed)
    return nullptr;
  return strongest_point(result.contacts[c]);
}

/// Where the resultant of a closed contact acts: its points weighted by force, on both bodies.
struct Resultant {
  Eigen::Vector3d point_ground = Eigen::Vector3d::Zero(), point_moving = Eigen::Vector3d::Zero();
};

Resultant resultant_of(const PoseResult& pose, std::size_t index) {
  const ContactResult& contact = pose.contacts[index];
  Resultant mean;
  if (contact.layer) return {contact.resultant_ground, *acting_place(contact, pose.X_BA, true)};
  if (!(contact.force > 0))
    return {contact.points.front().point_ground, contact.points.front().point_moving};
  for (const ContactPointResult& point : contact.points) {
    mean.point_ground += point.force / contact.force * point.point_ground;
    mean.point_moving += point.force / contact.force * point.point_moving;
  }
  return mean;
}

/// Of the body on which the place moves farther [mm].
template <typename Place>
double step_length(const Place& a, const Place& b) {
  return std::max((b.point_ground - a.point_ground).norm(),
                  (b.point_moving - a.point_moving).norm());
}

/// Does an event say that the contact was lost or went elsewhere between two values?
bool interrupted(const SweepResult& sweep, std::size_t contact, double from, double to) {
  const auto [low, high] = std::minmax(from, to);
  bool opened = false, closed = false;
  for (const Event& event : sweep.events) {
    if (event.value < low || event.value > high) continue;
    if (event.kind == EventKind::kLimitPoint) return true;
    if (event.contact != static_cast<int>(contact)) continue;
    if (event.kind == EventKind::kJump) return true;
    opened |= event.kind == EventKind::kOpening;
    closed |= event.kind == EventKind::kClosing;
  }
  return opened && closed;
}

/// Steps of a piece, per unit of the swept value; where that stands still, per step.
struct Steps {
  std::vector<double> length, speed;
};

/// place(pose): where the contact acts in that pose.
template <typename PlaceOf>
Steps steps_of(const SweepResult& sweep, const Piece& piece, const PlaceOf& place) {
  Steps steps;
  for (std::size_t i = 1; i < piece.size(); ++i) {
    const double change = std::abs(sweep.poses[piece[i]].value - sweep.poses[piece[i - 1]].value);
    steps.length.push_back(step_length(place(piece[i - 1]), place(piece[i])));
    steps.speed.push_back(change > 0 ? steps.length.back() / change : steps.length.back());
  }
  return steps;
}

/// The middle one of the speeds around a step; of an even number the greater.
double speed_around(const std::vector<double>& speed, std::size_t step) {
  std::vector<double> around;
  const std::size_t first = step - std::min(step, kAround);
  for (std::size_t i = first; i < std::min(speed.size(), step + kAround + 1); ++i)
    if (i != step) around.push_back(speed[i]);
  if (around.empty()) return speed[step];
  std::nth_element(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2),
                   around.end());
  return around[around.size() / 2];
}

bool is_jump(const Steps& steps, std::size_t step) {
  if (steps.length[step] > kFarStep) return true;
  return steps.length[step] > kShortStep &&
         steps.speed[step] > kFaster * speed_around(steps.speed, step);
}

/// The point of a contact that lies nearest to a place [mm, ground frame].
const ContactPointResult* nearest_point(const ContactResult& contact, const Eigen::Vector3d& p) {
  return &*std::min_element(contact.points.begin(), contact.points.end(),
                            [&](const ContactPointResult& a, const ContactPointResult& b) {
                              return (a.point_ground - p).norm() < (b.point_ground - p).norm();
                            });
}

/// Does another point carry most from one pose to the next, while both are there?
bool changes_point(const SweepResult& sweep, std::size_t from, std::size_t to, std::size_t c) {
  const ContactPointResult *a = place_of(sweep, from, c), *b = place_of(sweep, to, c);
  return nearest_point(sweep.poses[to].contacts[c], a->point_ground) != b ||
         nearest_point(sweep.poses[from].contacts[c], b->point_ground) != a;
}

/// Pieces that no event and no missing pose divides.
std::vector<Piece> unbroken(const SweepResult& sweep, std::size_t contact) {
  std::vector<Piece> pieces;
  Piece piece;
  for (std::size_t i = 0; i <= sweep.poses.size(); ++i) {
    const bool present = i < sweep.poses.size() && place_of(sweep, i, contact) != nullptr;
    const bool cut =
        !present || (!piece.empty() && interrupted(sweep, contact, sweep.poses[piece.back()].value,
                                                   sweep.poses[i].value));
    if (cut && !piece.empty()) pieces.push_back(std::exchange(piece, {}));
    if (present) piece.push_back(i);
  }
  return pieces;
}

}  // namespace

std::vector<Piece> contact_path(const SweepResult& sweep, std::size_t contact) {
  std::vector<Piece> path;
  for (const Piece& whole : unbroken(sweep, contact)) {
    const auto strongest = [&](std::size_t pose) { return *place_of(sweep, pose, contact); };
    const Steps steps = steps_of(sweep, whole, strongest);
    path.push_back({whole.front()});
    for (std::size_t i = 1; i < whole.size(); ++i) {
      if (is_jump(steps, i - 1) || changes_point(sweep, whole[i - 1], whole[i], contact))
        path.emplace_back();
      path.back().push_back(whole[i]);
    }
  }
  return path;
}

std::vector<Piece> resultant_path(const SweepResult& sweep, std::size_t contact) {
  std::vector<Piece> path;
  for (const Piece& whole : unbroken(sweep, contact)) {
    const auto resultant = [&](std::size_t pose) {
      return resultant_of(sweep.poses[pose], contact);
    };
    const Steps steps = steps_of(sweep, whole, resultant);
    path.push_back({whole.front()});
    for (std::size_t i = 1; i < whole.size(); ++i) {
      if (is_jump(steps, i - 1)) path.emplace_back();
      path.back().push_back(whole[i]);
    }
  }
  return path;
}

bool joined(const std::vector<Piece>& path, std::size_t a, std::size_t b) {
  return std::any_of(path.begin(), path.end(), [&](const Piece& piece) {
    return piece.front() <= std::min(a, b) && std::max(a, b) <= piece.back();
  });
}

}  // namespace condyle
