#include <fmt/format.h>
#include <fmt/os.h>

#include <cmath>
#include <functional>
#include <vector>

#include "accuracy/clock.h"
#include "accuracy/study.h"
#include "benchmark/patch_knee.h"
#include "equilibrium/equilibrium_solver.h"
#include "support/quadric_knee.h"

namespace condyle::accuracy {
namespace {

constexpr int kPoses = 18;

/// Time of a warm sweep over 90 degrees [us].
double sweep_time(
    Model model, int poses, int runs, bool stability = false, bool stiffness = false) {
  EquilibriumOptions options;
  options.description.stability = stability;
  options.description.joint_stiffness = stiffness;
  EquilibriumSolver solver(std::move(model), options);
  PoseResult pose;
  solver.solve(pose);
  bool forth = true;
  const auto sweep = [&] {
    for (int k = 0; k < poses; ++k) {
      solver.model().conditions[0].value =
          (forth ? k + 1 : poses - k) * (90.0 / poses) * M_PI / 180;
      solver.solve(pose);
    }
    forth = !forth;
  };
  return least_microseconds(runs, sweep);
}

/// Of a pose in steps of 5 degrees [us].
double pose_time(Model model, bool stability, bool stiffness = false) {
  return sweep_time(std::move(model), kPoses, 200, stability, stiffness) / kPoses;
}

Model without_search(Model model) {
  for (ContactPair& pair : model.pairs) pair.mode = ContactMode::kClosed;
  return model;
}

Model without_joint(Model model) {
  model.joint.reset();
  return model;
}

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

/// Exponent of the growth between two sizes.
double exponent(double n1, double t1, double n2, double t2) {
  return std::log(t2 / t1) / std::log(n2 / n1);
}

std::string parts(const std::filesystem::path& folder) {
  const std::vector<std::pair<std::string, std::function<double()>>> rows{
      {"exact surfaces, contacts held closed, nothing else",
       [] { return pose_time(without_joint(without_search(test::quadric_knee())), false); }},
      {"and joint coordinates",
       [] { return pose_time(without_search(test::quadric_knee()), false); }},
      {"and the search for contacts", [] { return pose_time(test::quadric_knee(), false); }},
      {"and stability", [] { return pose_time(test::quadric_knee(), true); }},
      {"and the joint's stiffness and compliance",
       [] { return pose_time(test::quadric_knee(), true, true); }},
      {"bicubic patches in place of exact surfaces, with the search",
       [] { return pose_time(benchmarks::patch_knee(), false); }}};
  fmt::ostream csv = fmt::output_file((folder / "parts.csv").string());
  csv.print("scene,microseconds\n");
  std::string page = "| the quadric knee, warm | time per pose |\n|---|---|\n";
  pose_time(test::quadric_knee(), false);  // the processor wakes up
  for (const auto& [name, time] : rows) {
    const double t = time();
    csv.print("\"{}\",{:.2f}\n", name, t);
    page += fmt::format("| {} | {:.1f} µs |\n", name, t);
  }
  return page;
}

/// What grows, how far, and the time at each size [us].
struct Growth {
  std::string name, time_of;
  std::vector<int> sizes;
  std::function<double(int)> time;
};

std::string growth(const std::filesystem::path& folder) {
  const std::vector<Growth> all{{"ligaments",
                                 "a pose",
                                 {8, 32, 128, 512, 1000},
                                 [](int n) { return pose_time(with_ligaments(n / 8), false); }},
                                {"control points each way of four patches",
                                 "a pose",
                                 {8, 16, 32, 64},
                                 [](int n) {
                                   return pose_time(benchmarks::patch_knee({n, n}), false);
                                 }},
                                {"poses over 90°", "the sweep", {9, 90, 900, 9000}, [](int n) {
                                   return sweep_time(test::quadric_knee(), n, 9000 / n + 2);
                                 }}};
  fmt::ostream csv = fmt::output_file((folder / "scaling.csv").string());
  csv.print("what,size,microseconds\n");
  std::string page = "\n| | size | time | exponent since the row above |\n|---|---|---|---|\n";
  for (const Growth& g : all) {
    double last_n = 0, last_t = 0;
    for (const int n : g.sizes) {
      const double t = g.time(n);
      csv.print("\"{}\",{},{:.2f}\n", g.name, n, t);
      page += fmt::format("| {} | {} | {:.1f} µs, {} | {} |\n", g.name, n, t, g.time_of,
                          last_n > 0 ? fmt::format("{:.2f}", exponent(last_n, last_t, n, t)) : "");
      last_n = n;
      last_t = t;
    }
  }
  return page;
}

}  // namespace

std::string study_costs(const std::filesystem::path& folder) {
  return "### What parts cost\n\n" + parts(folder) + growth(folder) + "\n";
}

}  // namespace condyle::accuracy
