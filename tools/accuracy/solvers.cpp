#include <fmt/format.h>
#include <fmt/os.h>

#include <algorithm>
#include <cmath>

#include "accuracy/clock.h"
#include "accuracy/peers.h"
#include "accuracy/study.h"
#include "equilibrium/equilibrium_solver.h"

namespace condyle::accuracy {
namespace {

constexpr int kPoses = 18;
constexpr double kStep = 5 * M_PI / 180;

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
  static_cast<void>(solver.solve());
  for (int k = 1; k <= kPoses; ++k) {
    Task& task = tasks.emplace_back();
    task.flexion = task.equations.flexion = k * kStep;
    task.start = solver.state();
    NewtonSystem at_start(solver.model());
    at_start.assemble(task.start);
    task.start_unknowns = unknowns_of(task.start, at_start, task.equations);

    solver.model().conditions[0].value = task.flexion;
    static_cast<void>(solver.solve());
    NewtonSystem at_end(solver.model());
    at_end.assemble(solver.state());
    KneeEquations there = task.equations;
    const Unknowns<double> near = unknowns_of(solver.state(), at_end, there);
    task.truth = solve_exactly(there, near);
  }
  return tasks;
}

/// Pose error after each iteration of our Newton, worst and typical of all poses.
std::string convergence(const std::vector<Task>& tasks, const std::filesystem::path& folder) {
  fmt::ostream csv = fmt::output_file((folder / "convergence.csv").string());
  csv.print("iteration,largest_pose_error,median_pose_error\n");
  std::string page = "| iterations | largest pose error | median |\n|---|---|---|\n";
  Model model = test::quadric_knee();
  for (int iterations = 0; iterations <= 6; ++iterations) {
    NewtonOptions options;
    options.max_iterations = iterations;
    options.tolerance = 0;
    Newton newton(model, options);
    std::vector<double> errors;
    for (const Task& task : tasks) {
      model.conditions[0].value = task.flexion;
      EquilibriumState state = task.start;
      newton.solve(state);
      errors.push_back(pose_error(task.truth, state.X, model.length));
    }
    std::sort(errors.begin(), errors.end());
    csv.print("{},{:.3e},{:.3e}\n", iterations, errors.back(), errors[errors.size() / 2]);
    page += fmt::format("| {} | {:.1e} | {:.1e} |\n", iterations, errors.back(),
                        errors[errors.size() / 2]);
  }
  return page;
}

/// What a tolerance buys.
std::string tolerances(const std::vector<Task>& tasks, const std::filesystem::path& folder) {
  fmt::ostream csv = fmt::output_file((folder / "tolerance.csv").string());
  csv.print("tolerance,largest_pose_error,iterations,microseconds\n");
  std::string page =
      "| tolerance | largest pose error | iterations | time per pose |\n|---|---|---|---|\n";
  Model model = test::quadric_knee();
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13}) {
    NewtonOptions options;
    options.tolerance = tolerance;
    Newton newton(model, options);
    double worst = 0;
    int iterations = 0;
    const auto all = [&] {
      worst = 0;
      iterations = 0;
      for (const Task& task : tasks) {
        model.conditions[0].value = task.flexion;
        EquilibriumState state = task.start;
        iterations += newton.solve(state).iterations;
        worst = std::max(worst, pose_error(task.truth, state.X, model.length));
      }
    };
    const double time = least_microseconds(200, all) / kPoses;
    csv.print("{:.0e},{:.3e},{:.2f},{:.2f}\n", tolerance, worst,
              iterations / static_cast<double>(kPoses), time);
    page += fmt::format("| {:.0e} | {:.1e} | {:.1f} | {:.1f} µs |\n", tolerance, worst,
                        iterations / static_cast<double>(kPoses), time);
  }
  return page;
}

struct Row {
  std::string name;
  int converged = 0;
  double iterations = 0, worst = 0, time = 0;
};

Row row_of(const Peer& peer, const std::vector<Task>& tasks) {
  Row row{peer.name, 0, 0, 0, 0};
  const auto all = [&] {
    row.converged = 0;
    row.iterations = row.worst = 0;
    for (const Task& task : tasks) {
      const PeerResult result = peer.solve(task.equations, task.start_unknowns);
      row.iterations += result.iterations / static_cast<double>(kPoses);
      if (!result.converged) continue;
      ++row.converged;
      row.worst = std::max(row.worst, pose_error(task.truth, pose_of(task.equations, result.x),
                                                 task.equations.model.length));
    }
  };
  row.time = least_microseconds(20, all) / kPoses;
  return row;
}

Row row_of_newton(const std::vector<Task>& tasks) {
  Row row{"ours, Newton alone", 0, 0, 0, 0};
  Model model = test::quadric_knee();
  Newton newton(model);
  EquilibriumState state = tasks.front().start;
  const auto all = [&] {
    row.converged = 0;
    row.iterations = row.worst = 0;
    for (const Task& task : tasks) {
      model.conditions[0].value = task.flexion;
      state = task.start;
      const NewtonReport report = newton.solve(state);
      row.iterations += report.iterations / static_cast<double>(kPoses);
      row.converged += report.outcome == NewtonOutcome::kConverged ? 1 : 0;
      row.worst = std::max(row.worst, pose_error(task.truth, state.X, model.length));
    }
  };
  row.time = least_microseconds(200, all) / kPoses;
  return row;
}

Row row_of_solver(const std::vector<Task>& tasks) {
  Row row{"ours, whole solver: predictor, search for contacts", 0, 0, 0, 0};
  EquilibriumOptions options;
  options.description.stability = false;
  EquilibriumSolver solver(test::quadric_knee(), options);
  PoseResult pose;
  solver.solve(pose);
  bool forth = true;
  const auto all = [&] {
    row.converged = 0;
    row.iterations = row.worst = 0;
    for (int k = 0; k < kPoses; ++k) {
      const Task& task = tasks[static_cast<std::size_t>(forth ? k : kPoses - 1 - k)];
      solver.model().conditions[0].value = task.flexion;
      solver.solve(pose);
      row.iterations += pose.iterations / static_cast<double>(kPoses);
      row.converged += pose.converged() ? 1 : 0;
      row.worst = std::max(row.worst, pose_error(task.truth, pose.X_BA, solver.model().length));
    }
    forth = !forth;
  };
  row.time = least_microseconds(200, all) / kPoses;
  return row;
}

std::string beside_others(const std::vector<Task>& tasks, const std::filesystem::path& folder) {
  std::vector<Row> rows{row_of_newton(tasks), row_of_solver(tasks)};
  for (const Peer& peer : peers()) rows.push_back(row_of(peer, tasks));
  fmt::ostream csv = fmt::output_file((folder / "solvers.csv").string());
  csv.print("solver,converged,poses,iterations,largest_pose_error,microseconds\n");
  std::string page =
      "| solver | converged | iterations | largest pose error | time per pose "
      "|\n|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    csv.print("\"{}\",{},{},{:.2f},{:.3e},{:.2f}\n", row.name, row.converged, kPoses,
              row.iterations, row.worst, row.time);
    page += fmt::format("| {} | {} of {} | {:.1f} | {:.1e} | {:.1f} µs |\n", row.name,
                        row.converged, kPoses, row.iterations, row.worst, row.time);
  }
  return page;
}

}  // namespace

std::string study_solvers(const std::filesystem::path& folder) {
  const std::vector<Task> tasks = make_tasks();
  double residual = 0;
  for (const Task& task : tasks) residual = std::max(residual, task.truth.residual);
  std::string page = fmt::format(
      "### Solver\n\nThe quadric knee, 18 steps of 5 degrees. Truth: implicit equations in long "
      "double, "
      "17 unknowns, residual {:.0e}. The pose error is the larger of |Δa|/L and the angle.\n\n"
      "Newton from the pose before:\n\n",
      residual);
  page += convergence(tasks, folder) + "\nWhat a tolerance buys:\n\n" + tolerances(tasks, folder);
  page += "\nBeside others, from the same starts to the same tolerance of 1e-12:\n\n";
  return page + beside_others(tasks, folder) + "\n";
}

}  // namespace condyle::accuracy
