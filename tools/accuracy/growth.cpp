#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "accuracy/clock.h"
#include "accuracy/study.h"
#include "benchmark/patch_knee.h"
#include "equilibrium/equilibrium_solver.h"
#include "support/kinematic_mount.h"
#include "support/quadric_knee.h"

namespace condyle::accuracy {
namespace {

constexpr double kSeconds = 2;  // for one figure at most

EquilibriumOptions without_stability() {
  EquilibriumOptions options;
  options.description.stability = false;
  return options;
}

/// Time of a warm sweep of a condition's value from 0 to `to` [us].
double sweep_time(Model model, int poses, double to) {
  EquilibriumSolver solver(std::move(model), without_stability());
  PoseResult pose;
  solver.solve(pose);
  bool forth = true;
  const auto sweep = [&] {
    for (int k = 0; k < poses; ++k) {
      solver.model().conditions[0].value = to * (forth ? k + 1 : poses - k) / poses;
      solver.solve(pose);
    }
    forth = !forth;
  };
  sweep();
  return least_microseconds(std::max(10, 9000 / poses), sweep, kSeconds);
}

/// Of a pose in steps of 5 degrees [us].
double knee_time(Model model) { return sweep_time(std::move(model), 18, M_PI / 2) / 18; }

/// The same ligaments, each `times` over with a part of the stiffness.
Model with_ligaments(int times) {
  Model model = test::quadric_knee();
  const std::size_t few = model.elements.size();
  for (LineElement& element : model.elements)
    std::get<ToeLinearLaw>(element.law).stiffness /= times;
  for (std::size_t i = few; i < few * static_cast<std::size_t>(times); ++i) {
    model.elements.push_back(model.elements[i % few]);
    model.element_names.push_back(model.element_names[i % few]);
  }
  return model;
}

/// The load turns back and forth: the scale of the side load is what varies.
double mount_time(int contacts) {
  EquilibriumSolver solver(test::kinematic_mount(contacts), without_stability());
  PoseResult pose;
  solver.solve(pose);
  if (!pose.converged() || test::closed_contacts(pose) != contacts)
    throw std::runtime_error(fmt::format("a mount of {} contacts does not stand", contacts));
  bool forth = true;
  const auto sweep = [&] {
    for (int k = 1; k <= 18; ++k) {
      solver.model().loads[1].scale = (forth ? k : 18 - k) / 18.0;
      solver.solve(pose);
    }
    forth = !forth;
  };
  sweep();
  return least_microseconds(500, sweep, kSeconds) / 18;
}

/// Pairs that are searched and stay open: walls a few millimetres below a condyle.
Model with_open_pairs(int pairs) {
  Model model = benchmarks::patch_knee();
  for (int k = 2; k < pairs; ++k) {
    ContactPair pair = model.pairs[0];
    pair.name = fmt::format("open {}", k);
    pair.on_A = make_plane({-23, -4, -28 - 0.01 * k}, Eigen::Vector3d::UnitZ());
    model.pairs.push_back(pair);
  }
  return model;
}

/// What grows, how far, and the time at each size [us].
struct Growth {
  std::string name, time_of;
  std::vector<int> sizes;
  std::function<double(int)> time;
  double most;  ///< of the exponent over the last two sizes
};

std::vector<Growth> all_growths() {
  return {
      {"poses over 90°",
       "the sweep",
       {9, 90, 900, 9000},
       [](int n) { return sweep_time(test::quadric_knee(), n, M_PI / 2); },
       1.3},
      {"ligaments",
       "a pose",
       {8, 32, 128, 512, 1024},
       [](int n) { return knee_time(with_ligaments(n / 8)); },
       1.2},
      {"contacts that carry", "a pose", {1, 2, 3, 4, 5, 6}, mount_time, 2.5},
      {"pairs that are searched, two of them closed",
       "a pose",
       {2, 4, 8, 16},
       [](int n) { return knee_time(with_open_pairs(n)); },
       1.3},
      {"control points of each patch, n x n",
       "a pose",
       {8, 16, 32, 64},
       [](int n) { return knee_time(benchmarks::patch_knee({n, n})); },
       0.5}};
}

}  // namespace

Study study_growth(const Setting& setting) {
  fmt::ostream csv = setting.table("scaling");
  csv.print("what,size,microseconds\n");
  Study study;
  study.page =
      "Warm poses of the quadric knee; contacts that carry: a body on six walls.\n\n"
      "| | size | time | exponent since the row above |\n|---|---|---|---|\n";
  for (const Growth& g : all_growths()) {
    double last_n = 0, last_t = 0, exponent = 0;
    for (const int n : g.sizes) {
      const double t = g.time(n);
      if (last_n > 0) exponent = std::log(t / last_t) / std::log(n / last_n);
      csv.print("\"{}\",{},{:.2f}\n", g.name, n, t);
      study.page += fmt::format("| {} | {} | {:.1f} µs, {} | {} |\n", g.name, n, t, g.time_of,
                                last_n > 0 ? fmt::format("{:.2f}", exponent) : "");
      last_n = n;
      last_t = t;
    }
    study.require(exponent <= g.most, fmt::format("{}: exponent {:.2f}", g.name, exponent));
  }
  return study;
}

}  // namespace condyle::accuracy
