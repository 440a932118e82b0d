#pragma once

/// One walk along a path of equilibria (arc_length.h): steps, corners of the path, and what happens on the way.

#include <optional>
#include <string>
#include <vector>

#include "condyle/equilibrium/contact_rules.h"
#include "condyle/equilibrium/path_options.h"
#include "condyle/equilibrium/path_system.h"
#include "condyle/equilibrium/walker.h"

namespace condyle {

class PathFollower {
 public:
  PathFollower(EquilibriumSolver& solver,
               const Swept& swept,
               const Drive& drive,
               double from,
               double to,
               double largest_step,
               const PathOptions& options);

  SweepResult follow();

 private:
  using Direction = PathSystem::Direction;
  static constexpr double kCorner =
      1e-5;  ///< a step [L] below which a path that turns has a corner

  struct Located {
    double length;  ///< from the present point
    Event event;
  };
  /// How the swept value goes where the path has come some length ahead of the present point.
  struct Sample {
    double length, value, rate;  ///< rate: of the value by that length
  };
  /// Lengths ahead between which contacts change.
  struct Bracket {
    double before, after;
  };
  struct Ahead {
    SolvedPose pose;
    bool usable = false;  ///< of equilibrium
    std::vector<Located> events;
  };

  // Steps (path_follower.cpp)

  static void reverse(Direction& direction);
  void append(PoseResult pose);
  void stop(const std::string& why);
  bool look_at(const PathPoint& point, SolvedPose& pose);
  /// The pose at a point `length` ahead of the present one and what happens on the way; false where not all of that can
  /// be located, as the path has a corner between.
  bool look_ahead(const PathPoint& point, double length, Ahead& ahead);
  /// That pose is the next one, with those events; false where it is none of equilibrium.
  bool tell(Ahead ahead);
  [[nodiscard]] double wanted_length() const;
  /// The point of the path some length ahead of the present one.
  std::optional<PathPoint> at(double length);
  /// One pose further; false at the end of the path.
  bool step();
  bool try_step();
  /// The length at which the swept value first passes `to`; `ways`: along which it grows or falls all the time, one after
  /// the other, by their ends.
  std::optional<double> length_to_end(const std::vector<Sample>& ways);
  /// The last pose, with the swept value at `to` itself.
  bool finish(double length);

  // Where contacts and ligaments change (path_corners.cpp)

  ContactChanges changes_at(const PathPoint& point);
  /// Where a ligament comes to lie on a surface or leaves it stiffness jumps, and the path may turn by any angle: on
  /// along the tangent that it has with the ligament as it lies just ahead, in the sense in which it stays so.
  bool turn_corner();
  /// Bisection for the length up to which contacts push and nothing overlaps, or to which the path can be followed.
  Bracket first_change(double length);
  /// Releases the contact that pulls after a change, or closes the one that overlaps there, and turns
  /// into the branch that agrees with it.
  bool change_contacts(const Bracket& part);
  /// Has the path turned here before? It runs round for ever then, and stops.
  bool been_at(const PathPoint& point);
  bool release(int contact, PathPoint& point, Direction& tangent);
  bool close(const ClosedContact& contact, PathPoint& point, Direction& tangent);
  /// Back to equilibrium with changed contacts, along the new path's own normal.
  bool settle(PathPoint& point, Direction& tangent);

  // Events (path_events.cpp)

  /// `tangent` in either sense.
  [[nodiscard]] Sample sample_of(double length,
                                 const PathPoint& point,
                                 const Direction& tangent) const;
  std::optional<Sample> sample(double length);
  /// Here, each limit point up to `end` and that itself: where the swept value stops growing, or begins to.
  std::vector<Sample> ways_to(const Sample& end);
  void find_limits(const Sample& left,
                   const Sample& right,
                   int halvings,
                   std::vector<Sample>& ways);
  /// What differs but for contacts that forces and gaps close and open (change_contacts).
  [[nodiscard]] std::vector<Event> changes(const PoseResult& before,
                                           const PoseResult& after,
                                           double value) const;
  /// Where what the last pose tells changes on the way to another one that lies `length` ahead; false where the way
  /// cannot be followed, and what was found is the least that holds it.
  bool locate_changes(const PoseResult& last, double length, std::vector<Located>& located);

  Walker walker_;
  const Model& model_;
  double from_, to_, largest_step_;
  const PathOptions& options_;
  PathSystem system_;
  std::vector<ContactSearch> searches_;
  ContactRules rules_;
  PathPoint point_;
  std::optional<PoseResult> told_;  ///< at that point, where that is known
  Direction tangent_;
  std::vector<PathPoint> turns_;  ///< where contacts changed and the swept value turned so far
  std::vector<Located> located_;  ///< in this step
  SweepResult result_;
};

}  // namespace condyle
