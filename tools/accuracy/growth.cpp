#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/clock.h"
#include "accuracy/phantom_truth.h"
#include "accuracy/study.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/specimen/fit_surfaces.h"
#include "support/kinematic_mount.h"
#include "support/patch_knee.h"
#include "support/quadric_knee.h"

namespace condyle::accuracy {
namespace {

constexpr int kRuns = 100000;     // at most,
constexpr double kSeconds = 1.5;  // and no longer, for one figure

EquilibriumOptions without_stability() {
  EquilibriumOptions options;
  options.description.stability = false;
  return options;
}

/// Time of a warm sweep of a condition's value from 0 to `to` [us].
double sweep_time(Model model, int poses, double to) {
  EquilibriumSolver solver(std::move(model), without_stability());
  Drive drive = drive_of(solver.model());
  PoseResult pose;
  solver.solve(drive, pose);
  bool forth = true;
  const auto sweep = [&] {
    for (int k = 0; k < poses; ++k) {
      drive.values[0] = to * (forth ? k + 1 : poses - k) / poses;
      solver.solve(drive, pose);
    }
    forth = !forth;
  };
  sweep();
  return least_microseconds(kRuns, sweep, kSeconds);
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
  Drive drive = drive_of(solver.model());
  PoseResult pose;
  solver.solve(drive, pose);
  if (!pose.converged() || test::closed_contacts(pose) != contacts)
    throw std::runtime_error(fmt::format("a mount of {} contacts does not stand", contacts));
  bool forth = true;
  const auto sweep = [&] {
    for (int k = 1; k <= 18; ++k) {
      drive.scales[1] = (forth ? k : 18 - k) / 18.0;
      solver.solve(drive, pose);
    }
    forth = !forth;
  };
  sweep();
  return least_microseconds(kRuns, sweep, kSeconds) / 18;
}

/// Beside the two closed pairs, walls a few millimetres below a condyle.
Model with_open_pairs(int pairs) {
  Model model = benchmarks::patch_knee();
  for (int k = 1; k <= pairs; ++k) {
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
};

std::vector<Growth> all_growths() {
  return {{"poses over 90°",
           "the sweep",
           {9, 90, 900, 9000},
           [](int n) { return sweep_time(test::quadric_knee(), n, M_PI / 2); }},
          {"ligaments",
           "a pose",
           {8, 32, 128, 512, 1024},
           [](int n) { return knee_time(with_ligaments(n / 8)); }},
          {"contacts that carry", "a pose", {1, 2, 3, 4, 5, 6}, mount_time},
          {"open contacts",
           "a pose",
           {1, 2, 4, 8, 16},
           [](int n) { return knee_time(with_open_pairs(n)); }},
          {"control points each way of each patch", "a pose", {8, 16, 32, 64}, [](int n) {
             return knee_time(benchmarks::patch_knee({n, n}));
           }}};
}

/// Rows of one growth; the exponents between them.
class Rows {
 public:
  Rows(std::string name, std::string time_of, fmt::ostream& csv, Study& study)
      : name_(std::move(name)), time_of_(std::move(time_of)), csv_(csv), study_(study) {}
  void add(double size, double microseconds) {
    std::string since;
    if (last_size_ > 0)
      since = fmt::format("{:.2f}", exponent(last_size_, last_time_, size, microseconds));
    all_.emplace_back(size, microseconds);
    csv_.print("\"{}\",{},{:.2f}\n", name_, size, microseconds);
    const std::string time = microseconds > 1e4 ? fmt::format("{:.0f} ms", microseconds / 1e3)
                                                : fmt::format("{:.1f} µs", microseconds);
    study_.page +=
        fmt::format("| {} | {:.0f} | {}, {} | {} |\n", name_, size, time, time_of_, since);
    last_size_ = size;
    last_time_ = microseconds;
  }
  /// Over the upper half of the sizes.
  [[nodiscard]] std::string in_short() const {
    const auto& [size, time] = all_[all_.size() / 2];
    const double e = exponent(size, time, last_size_, last_time_);
    return fmt::format("{} {:.1f}", name_, std::abs(e) < 0.05 ? 0 : e);
  }

 private:
  static double exponent(double size, double time, double later_size, double later_time) {
    return std::log(later_time / time) / std::log(later_size / size);
  }

  std::string name_, time_of_;
  fmt::ostream& csv_;
  Study& study_;
  std::vector<std::pair<double, double>> all_;  // sizes and times
  double last_size_ = 0, last_time_ = 0;
};

/// Reading and cleaning the phantom's two meshes, and that with four patches.
std::vector<std::string> mesh_growth(const Setting& setting, fmt::ostream& csv, Study& study) {
  Rows reading("triangles read", "reading and cleaning", csv, study);
  Rows patches("triangles fitted", "until four patches", csv, study);
  std::vector<std::array<double, 3>> measured;
  MeshFiles files(setting.folder / "meshes");
  Scene scene = phantom_scene(setting.root, 10);
  for (const double grid : {2.0, 1.4, 1.0, 0.7}) {
    files.write({grid, 0, 0, 0}, scene);
    double triangles = 0;
    const double read = processor_microseconds([&] {
      triangles = 0;
      for (const BodyDescription& body : scene.bodies)
        triangles += static_cast<double>(load_body_mesh(body).triangles.size());
    });
    const double fitted = least_microseconds(3, [&] { static_cast<void>(fit_surfaces(scene)); });
    measured.push_back({triangles, read, fitted});
  }
  for (const auto& [triangles, read, fitted] : measured) reading.add(triangles, read);
  for (const auto& [triangles, read, fitted] : measured) patches.add(triangles, fitted);
  return {reading.in_short(), patches.in_short()};
}

}  // namespace

Study study_growth(const Setting& setting) {
  fmt::ostream csv = setting.table("scaling");
  csv.print("what,size,microseconds\n");
  Study study;
  study.page =
      "Warm poses of the quadric knee (open contacts: walls 4 mm below a condyle, beside the two "
      "that "
      "carry), of a body on one to six walls, and meshes of the phantom.\n\n"
      "| | size | time | exponent since the row above |\n|---|---|---|---|\n";
  std::vector<std::string> exponents;
  for (const Growth& g : all_growths()) {
    Rows rows(g.name, g.time_of, csv, study);
    for (const int n : g.sizes) rows.add(n, g.time(n));
    exponents.push_back(rows.in_short());
  }
  for (const std::string& more : mesh_growth(setting, csv, study)) exponents.push_back(more);
  study.in_short = {fmt::format(
      "**Time grows** with these exponents, over the upper half of the sizes below: {}.",
      fmt::join(exponents, "; "))};
  return study;
}

}  // namespace condyle::accuracy
