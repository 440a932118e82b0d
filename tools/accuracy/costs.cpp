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

/// Time of a warm pose in steps of 5 degrees [us].
double pose_time(Model model, bool stability, bool stiffness = false) {
  EquilibriumOptions options;
  options.description.stability = stability;
  options.description.joint_stiffness = stiffness;
  EquilibriumSolver solver(std::move(model), options);
  PoseResult pose;
  solver.solve(pose);
  bool forth = true;
  const auto sweep = [&] {
    for (int k = 0; k < kPoses; ++k) {
      solver.model().conditions[0].value = (forth ? k + 1 : kPoses - k) * 5 * M_PI / 180;
      solver.solve(pose);
    }
    forth = !forth;
  };
  return least_microseconds(200, sweep) / kPoses;
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

std::string growth(const std::filesystem::path& folder) {
  fmt::ostream csv = fmt::output_file((folder / "scaling.csv").string());
  csv.print("ligaments,microseconds\n");
  std::string page =
      "\n| ligaments | time per pose | exponent since the row above |\n|---|---|---|\n";
  double last_n = 0, last_t = 0;
  for (const int times : {1, 4, 16, 64, 125}) {
    const double t = pose_time(with_ligaments(times), false), n = 8.0 * times;
    csv.print("{:.0f},{:.2f}\n", n, t);
    page += fmt::format("| {:.0f} | {:.1f} µs | {} |\n", n, t,
                        last_n > 0 ? fmt::format("{:.2f}", exponent(last_n, last_t, n, t)) : "");
    last_n = n;
    last_t = t;
  }
  return page;
}

}  // namespace

std::string study_costs(const std::filesystem::path& folder) {
  return "### What parts cost\n\n" + parts(folder) + growth(folder) + "\n";
}

}  // namespace condyle::accuracy
