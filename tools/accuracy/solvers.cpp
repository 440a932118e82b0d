#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "accuracy/clock.h"
#include "accuracy/condensed_peers.h"
#include "accuracy/peers.h"
#include "accuracy/study.h"
#include "condyle/equilibrium/equilibrium_solver.h"

namespace condyle::accuracy {
namespace {

constexpr int kPoses = 18;
constexpr double kStep = 5 * M_PI / 180;
constexpr int kRuns = 100000;     // at most,
constexpr double kSeconds = 1.5;  // and no longer, for one figure

/// One pose of a sweep of 5 degrees a step: where a solver starts, and where it should end.
struct Task {
  double flexion = 0;
  EquilibriumState start;
  KneeEquations equations;          ///< R0 that of the start
  Unknowns<double> start_unknowns;  ///< g = 0
  ExactPose truth;
};

std::vector<Task> make_tasks() {
  std::vector<Task> tasks;
  EquilibriumSolver solver(test::quadric_knee());
  Drive drive = drive_of(solver.model());
  static_cast<void>(solver.solve(drive));
  for (int k = 1; k <= kPoses; ++k) {
    Task& task = tasks.emplace_back();
    task.flexion = task.equations.flexion = k * kStep;
    task.start = solver.state();
    NewtonSystem at_start(solver.model());
    at_start.assemble(task.start, drive);
    task.start_unknowns = unknowns_of(task.start, at_start, task.equations);

    drive.values[0] = task.flexion;
    static_cast<void>(solver.solve(drive));
    NewtonSystem at_end(solver.model());
    at_end.assemble(solver.state(), drive);
    KneeEquations there = task.equations;
    const Unknowns<double> near = unknowns_of(solver.state(), at_end, there);
    task.truth = solve_exactly(there, near);
  }
  return tasks;
}

/// What is wrong at one pose or at all.
struct Errors {
  double pose = 0, force = 0;  ///< [-], [N]
  void take(const Task& task, const RigidTransform& X, const std::array<double, 2>& contacts) {
    pose = std::max(pose, pose_error(task.truth, X, task.equations.model.length));
    force = std::max(force, force_error(task.equations, task.truth, X, contacts));
  }
  void take(const Task& task, const EquilibriumState& state) {
    take(task, state.X, contact_forces(state));
  }
};

/// Of all poses after so many iterations of our Newton, ascending by the error of the pose.
std::vector<Errors> errors_after(int iterations, const std::vector<Task>& tasks) {
  const Model model = test::quadric_knee();
  NewtonOptions options;
  options.max_iterations = iterations;
  options.tolerance = 0;
  Newton newton(model, options);
  Drive drive = drive_of(model);
  std::vector<Errors> errors;
  for (const Task& task : tasks) {
    drive.values[0] = task.flexion;
    EquilibriumState state = task.start;
    newton.solve(state, drive);
    errors.emplace_back().take(task, state);
  }
  std::sort(errors.begin(), errors.end(),
            [](const Errors& a, const Errors& b) { return a.pose < b.pose; });
  return errors;
}

/// The order is that of three errors in a row: log(e2/e1) / log(e1/e0).
void convergence(const std::vector<Task>& tasks, const Setting& setting, Study& study) {
  constexpr double kRoundOff = 1e-14;
  fmt::ostream csv = setting.table("convergence");
  csv.print("iteration,largest_pose_error,median_pose_error,largest_force_error_N\n");
  study.page +=
      "| iterations | largest pose error | median | order | largest force error [N] |\n"
      "|---|---|---|---|---|\n";
  std::vector<double> largest;
  double last_order = 0;
  for (int iterations = 0; iterations <= 6; ++iterations) {
    const std::vector<Errors> errors = errors_after(iterations, tasks);
    const double median = errors[errors.size() / 2].pose;
    double force = 0;
    for (const Errors& error : errors) force = std::max(force, error.force);
    largest.push_back(errors.back().pose);
    const std::size_t n = largest.size();
    std::string order;
    if (n >= 3 && largest[n - 2] > kRoundOff) {
      last_order =
          std::log(largest[n - 1] / largest[n - 2]) / std::log(largest[n - 2] / largest[n - 3]);
      order = fmt::format("{:.1f}", last_order);
    }
    csv.print("{},{:.3e},{:.3e},{:.3e}\n", iterations, largest.back(), median, force);
    study.page += fmt::format("| {} | {:.1e} | {:.1e} | {} | {:.1e} |\n", iterations,
                              largest.back(), median, order, force);
  }
  study.require(last_order > 1.8 && last_order < 2.4, "Newton converges quadratically");
}

/// What a tolerance buys.
void tolerances(const std::vector<Task>& tasks, const Setting& setting, Study& study) {
  fmt::ostream csv = setting.table("tolerance");
  csv.print("tolerance,largest_pose_error,iterations,microseconds,largest_force_error_N\n");
  study.page +=
      "| tolerance | largest pose error | largest force error [N] | iterations | time per pose |\n"
      "|---|---|---|---|---|\n";
  const Model model = test::quadric_knee();
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13}) {
    NewtonOptions options;
    options.tolerance = tolerance;
    Newton newton(model, options);
    Drive drive = drive_of(model);
    std::vector<EquilibriumState> ends;
    for (const Task& task : tasks) ends.push_back(task.start);
    int iterations = 0;
    const auto all = [&] {
      iterations = 0;
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        drive.values[0] = tasks[i].flexion;
        ends[i] = tasks[i].start;
        iterations += newton.solve(ends[i], drive).iterations;
      }
    };
    const double time = least_microseconds(kRuns, all, kSeconds) / kPoses;
    Errors worst;
    for (std::size_t i = 0; i < tasks.size(); ++i) worst.take(tasks[i], ends[i]);
    const double mean = iterations / static_cast<double>(kPoses);
    csv.print("{:.0e},{:.3e},{:.2f},{:.2f},{:.3e}\n", tolerance, worst.pose, mean, time,
              worst.force);
    study.page += fmt::format("| {:.0e} | {:.1e} | {:.1e} | {:.1f} | {:.1f} µs |\n", tolerance,
                              worst.pose, worst.force, mean, time);
  }
}

struct Row {
  std::string name;
  int converged = 0;
  double iterations = 0, time = 0;  ///< of a pose [us]
  Errors worst = {};
};

Row row_of(const Peer& peer, const std::vector<Task>& tasks) {
  Row row{peer.name};
  std::vector<PeerResult> results(tasks.size());
  const auto all = [&] {
    for (std::size_t i = 0; i < tasks.size(); ++i)
      results[i] = peer.solve(tasks[i].equations, tasks[i].start_unknowns);
  };
  row.time = least_microseconds(kRuns, all, kSeconds) / kPoses;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    row.iterations += results[i].iterations / static_cast<double>(kPoses);
    if (!results[i].converged) continue;
    ++row.converged;
    row.worst.take(tasks[i], pose_of(tasks[i].equations, results[i].x),
                   contact_forces(results[i].x));
  }
  return row;
}

Row row_of(const CondensedPeer& peer, const Model& model, const std::vector<Task>& tasks) {
  Row row{peer.name};
  std::vector<CondensedResult> results(tasks.size());
  Drive drive = drive_of(model);
  const auto all = [&] {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      drive.values[0] = tasks[i].flexion;
      results[i] = peer.solve(tasks[i].start, drive);
    }
  };
  row.time = least_microseconds(kRuns, all, kSeconds) / kPoses;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    row.iterations += results[i].iterations / static_cast<double>(kPoses);
    if (!results[i].converged) continue;
    ++row.converged;
    row.worst.take(tasks[i], results[i].state);
  }
  return row;
}

Row row_of_newton(const std::vector<Task>& tasks) {
  Row row{"ours, Newton alone"};
  const Model model = test::quadric_knee();
  Newton newton(model);
  Drive drive = drive_of(model);
  std::vector<EquilibriumState> ends;
  for (const Task& task : tasks) ends.push_back(task.start);
  const auto all = [&] {
    row.converged = 0;
    row.iterations = 0;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      drive.values[0] = tasks[i].flexion;
      ends[i] = tasks[i].start;
      const NewtonReport report = newton.solve(ends[i], drive);
      row.iterations += report.iterations / static_cast<double>(kPoses);
      row.converged += report.outcome == NewtonOutcome::kConverged ? 1 : 0;
    }
  };
  row.time = least_microseconds(kRuns, all, kSeconds) / kPoses;
  for (std::size_t i = 0; i < tasks.size(); ++i) row.worst.take(tasks[i], ends[i]);
  return row;
}

/// Forth and back, so that each sweep starts where the one before ended.
Row row_of_solver(const std::vector<Task>& tasks) {
  Row row{"ours, whole solver: predictor, search for contacts"};
  EquilibriumOptions options;
  options.description.stability = false;
  EquilibriumSolver solver(test::quadric_knee(), options);
  Drive drive = drive_of(solver.model());
  PoseResult pose;
  solver.solve(drive, pose);
  std::vector<EquilibriumState> ends(tasks.size(), solver.state());
  bool forth = true;
  const auto all = [&] {
    row.converged = 0;
    row.iterations = 0;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      const std::size_t i = forth ? k : tasks.size() - 1 - k;
      drive.values[0] = tasks[i].flexion;
      solver.solve(drive, pose);
      row.iterations += pose.iterations / static_cast<double>(kPoses);
      row.converged += pose.converged() ? 1 : 0;
      ends[i] = solver.state();
    }
    forth = !forth;
  };
  row.time = least_microseconds(kRuns, all, kSeconds) / kPoses;
  for (std::size_t i = 0; i < tasks.size(); ++i) row.worst.take(tasks[i], ends[i]);
  return row;
}

void beside_others(const std::vector<Task>& tasks, const Setting& setting, Study& study) {
  std::vector<Row> rows{row_of_newton(tasks), row_of_solver(tasks)};
  for (const Peer& peer : peers()) rows.push_back(row_of(peer, tasks));
  const Model model = test::quadric_knee();
  for (const CondensedPeer& peer : condensed_peers(model))
    rows.push_back(row_of(peer, model, tasks));
  fmt::ostream csv = setting.table("solvers");
  csv.print(
      "solver,converged,poses,iterations,largest_pose_error,microseconds,largest_force_error_N\n");
  study.page +=
      "| solver | converged | iterations | largest pose error | largest force error [N] | time per "
      "pose |\n|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    csv.print("\"{}\",{},{},{:.2f},{:.3e},{:.2f},{:.3e}\n", row.name, row.converged, kPoses,
              row.iterations, row.worst.pose, row.time, row.worst.force);
    study.page += fmt::format("| {} | {} of {} | {:.1f} | {:.1e} | {:.1e} | {:.1f} µs |\n",
                              row.name, row.converged, kPoses, row.iterations, row.worst.pose,
                              row.worst.force, row.time);
  }
  const Row& whole = rows[1];
  study.require(whole.converged == kPoses && whole.worst.pose < 1e-11,
                "the solver's poses are those in long double");
  study.in_short.push_back(fmt::format(
      "**A pose of two contacts and eight ligaments costs {:.0f} µs**, with the search for "
      "contacts "
      "anywhere on the surfaces, and is right to {:.0e} (forces to {:.0e} N). Convergence is "
      "quadratic: the last digits of the tolerance cost next to nothing.",
      whole.time, whole.worst.pose, whole.worst.force));
}

}  // namespace

Study study_solvers(const Setting& setting) {
  const std::vector<Task> tasks = make_tasks();
  double residual = 0;
  for (const Task& task : tasks) residual = std::max(residual, task.truth.residual);
  Study study;
  study.page = fmt::format(
      "The quadric knee, 18 steps of 5 degrees. Truth: implicit equations in long double, 17 "
      "unknowns, residual {:.0e}. Pose error: the larger of |Δa|/L and the angle. Force error: of "
      "contacts and ligaments, under a load of 200 N.\n\n"
      "Newton from the pose "
      "before:\n\n",
      residual);
  convergence(tasks, setting, study);
  study.page += "\nWhat a tolerance buys:\n\n";
  tolerances(tasks, setting, study);
  study.page += "\nBeside others, from the same starts to the same tolerance of 1e-12:\n\n";
  beside_others(tasks, setting, study);
  return study;
}

}  // namespace condyle::accuracy
