#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "condyle/contact/contact.h"
#include "condyle/reference/joint_rotation.h"
#include "condyle/reference/wismans_solver.h"
#include "condyle/reference/wismans_system.h"

namespace condyle {
namespace {

using Clock = std::chrono::steady_clock;

ContactPointResult describe_point(const WismansModel& model,
                                  const WismansVector& unknowns,
                                  int index,
                                  const RigidTransform& X_BA,
                                  std::string& remark) {
  const WismansContact& contact = model.contacts[static_cast<std::size_t>(index)];
  const Eigen::Vector2d at_B = unknowns.segment<2>(wismans::on_B(index)),
                        at_A = unknowns.segment<2>(wismans::on_A(index));
  const HeightPoint B = evaluate(contact.on_B, at_B), A = evaluate(contact.on_A, at_A);
  const auto surface = [](const HeightSurface& s) {
    return make_polynomial(s.origin, s.axes, s.terms, s.solid_below);
  };
  ContactPointResult point;
  point.force = unknowns[wismans::kForce + index];
  point.point_ground = B.c;
  point.point_moving = A.c;
  point.normal_ground = B.n;
  point.gap = B.n.dot(X_BA * A.c - B.c);
  point.relative_curvature =
      linearize_contact({*surface(contact.on_B), *surface(contact.on_A)}, {{B.c}, {A.c}}, X_BA)
          .relative_curvature;
  point.edge_distance =
      std::min(distance_to_outline(contact.on_B, at_B), distance_to_outline(contact.on_A, at_A));
  point.on_edge = point.edge_distance < 0;
  const auto say = [&](const std::string& text) { remark += (remark.empty() ? "" : "; ") + text; };
  if (point.force < 0)
    say(fmt::format("{} contact pulls with {:.1f} N", contact.name, -point.force));
  if (point.on_edge)
    say(fmt::format("{} contact is {:.1f} mm beyond the points that its polynomials stand for",
                    contact.name, -point.edge_distance));
  if (point.relative_curvature[0] < 0)
    say(fmt::format("the surfaces cut into each other beside the {} contact", contact.name));
  return point;
}

std::string reason_of(const WismansSolution& solution) {
  switch (solution.status) {
    case PoseStatus::kIterationLimit:
      return fmt::format("Newton-Raphson did not settle in {} iterations", solution.iterations);
    case PoseStatus::kDiverged:
      return "Newton-Raphson ran away";
    case PoseStatus::kSingular:
      return "the matrix of the 16 equations is singular";
    default:
      return "the equations are met where the two solids lie on the same side";
  }
}

/// A new flexion turns the body about the middle of its contacts, not about an origin that may be
/// far away.
WismansVector turned_to(const WismansModel& model, double flexion, const WismansVector& unknowns) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int c = 0; c < 2; ++c) {
    middle += 0.5 * evaluate(model.contacts[static_cast<std::size_t>(c)].on_A,
                             unknowns.segment<2>(wismans::on_A(c)))
                        .c;
  }
  const Eigen::Vector3d before(flexion, unknowns[wismans::kAdduction],
                               unknowns[wismans::kInternalRotation]);
  WismansVector turned = unknowns;
  turned.head<3>() += (joint_rotation(model.joint, before).R - pose_of(model, unknowns).R) * middle;
  return turned;
}

/// One sweep: stands at the last solution, and takes a step in parts where it must.
class Sweep {
 public:
  Sweep(WismansModel& model, double& swept, const WismansOptions& options)
      : model_(model), swept_(swept), options_(options) {}

  bool start(const std::vector<RigidTransform>& poses, double value) {
    swept_ = value;
    for (const RigidTransform& X_BA : poses) {
      if (attempt(first_guess(model_, X_BA))) return true;
    }
    return false;
  }

  bool go_to(double value) {
    const double from = at_;
    double part = 1, done = 0;
    for (int halved = 0; halved <= options_.halvings;) {
      const double next = std::min(1.0, done + part);
      swept_ = next < 1 ? from + next * (value - from) : value;
      if (attempt(turned_to(model_, at_flexion_, now_.unknowns))) {
        done = next;
        if (done == 1) return true;
      } else {
        part /= 2;
        ++halved;
      }
    }
    return false;
  }

  WismansSolution last_;  ///< of the last attempt, with the iterations of all
  void forget_iterations() { iterations_ = 0; }

 private:
  bool attempt(const WismansVector& start) {
    WismansSolution solution = solve(model_, start, options_);
    iterations_ += solution.iterations;
    solution.iterations = iterations_;
    last_ = solution;
    if (!solution.converged()) return false;
    now_ = solution;
    at_ = swept_;
    at_flexion_ = model_.flexion;
    return true;
  }

  WismansModel& model_;
  double& swept_;
  const WismansOptions& options_;
  WismansSolution now_;
  double at_ = 0, at_flexion_ = 0;  ///< of the last solution
  int iterations_ = 0;
};

}  // namespace

PoseResult describe(const WismansModel& model, const WismansSolution& solution) {
  PoseResult pose;
  pose.status = solution.status;
  pose.iterations = solution.iterations;
  pose.residual = solution.residual;
  if (!solution.converged()) {
    pose.reason = reason_of(solution);
    return pose;
  }
  begin_pose(
      {pose_of(model, solution.unknowns), &model.joint, model.springs, {}, model.scene_contacts},
      pose);
  for (int c = 0; c < 2; ++c)
    add_closed_point(describe_point(model, solution.unknowns, c, pose.X_BA, pose.remark),
                     pose.contacts[model.contacts[static_cast<std::size_t>(c)].index]);
  pose.conditions = {{model.flexion, solution.unknowns[wismans::kMoment]}};
  to_file_frames(model.origins, pose);
  return pose;
}

SweepResult sweep(WismansModel model,
                  std::optional<std::size_t> load,
                  const std::vector<double>& values,
                  const std::vector<RigidTransform>& other_starts,
                  const WismansOptions& options) {
  std::vector<RigidTransform> starts = {model.start};
  starts.insert(starts.end(), other_starts.begin(), other_starts.end());
  for (RigidTransform& X_BA : starts) X_BA = model.origins.into_model(X_BA);
  double& swept = load ? model.loads.at(*load).scale : model.flexion;
  Sweep walk(model, swept, options);
  SweepResult result;
  bool started = false;
  for (const double value : values) {
    const auto begin = Clock::now();
    walk.forget_iterations();
    started = (started && walk.go_to(value)) || walk.start(starts, value) || started;
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    swept = value;
    PoseResult pose = describe(model, walk.last_);
    pose.value = value;
    pose.seconds = seconds;
    result.poses.push_back(std::move(pose));
  }
  return result;
}

}  // namespace condyle
