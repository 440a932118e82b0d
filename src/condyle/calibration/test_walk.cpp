#include "condyle/calibration/test_walk.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

namespace condyle {
namespace {

using Standing = EquilibriumSolver::Standing;

constexpr double kFlexionStep = 5 * std::numbers::pi / 180;
constexpr double kLoadStep = 0.1;  // of the greatest level

int parts_of(double way, double step) {
  constexpr double kRounding = 1e-9;
  return step > 0 ? std::max(1, static_cast<int>(std::ceil(std::abs(way) / step - kRounding))) : 1;
}

Drive between(const Drive& from, const Drive& to, double t) {
  if (t == 1) return to;
  Drive drive = to;
  for (std::size_t i = 0; i < to.values.size(); ++i)
    drive.values[i] = from.values[i] + t * (to.values[i] - from.values[i]);
  for (std::size_t i = 0; i < to.scales.size(); ++i)
    drive.scales[i] = from.scales[i] + t * (to.scales[i] - from.scales[i]);
  return drive;
}

class TestWalk {
 public:
  TestWalk(const Scene& scene,
           const MeasuredModels& models,
           const TestPoses& tests,
           TestBench& bench)
      : scene_(scene),
        models_(models),
        tests_(tests),
        bench_(bench),
        reached_(tests.poses.size()) {}

  std::vector<ReachedPose> walk() {
    flex();
    load();
    mend();
    return std::move(reached_);
  }

 private:
  bool go(std::size_t model, Standing& at, const Drive& to, int parts, std::string& reason);
  void flex();
  void flex_through(const std::vector<double>& flexions, const std::optional<Standing>& start);
  void load();
  void load_along(const std::vector<std::size_t>& curve, const Standing& unloaded, double begin);
  void mend();
  void keep(std::size_t pose, const Standing& standing) { reached_[pose] = {standing, {}}; }
  [[nodiscard]] Drive unloaded_drive(double flexion) const;
  [[nodiscard]] Standing held(const Standing& free, std::size_t model, double& value) const;

  const Scene& scene_;
  const MeasuredModels& models_;
  const TestPoses& tests_;
  TestBench& bench_;
  std::vector<ReachedPose> reached_;
  std::map<double, Standing> unloaded_;  ///< by flexion
  PoseResult result_;
};

/// From a standing, or where it has no state from the start pose, to a drive in equal parts; a part that
/// fails is left out. True where the last one is solved.
bool TestWalk::go(
    std::size_t model, Standing& at, const Drive& to, int parts, std::string& reason) {
  EquilibriumSolver& solver = bench_.solver(model);
  if (!at.has_state) {
    solver.reset();
    parts = 1;
  } else {
    solver.go_back(at);
  }
  const Drive from = at.has_state ? at.solved : to;
  for (int i = 1; i <= parts; ++i) {
    const bool last = i == parts;
    solver.solve(between(from, to, last ? 1 : static_cast<double>(i) / parts), result_,
                 last ? Patience::kAll : Patience::kWay);
    ++bench_.solved;
    if (!result_.converged()) ++bench_.failed;
    if (result_.converged()) at = solver.standing();
  }
  if (!result_.converged()) reason = result_.reason.empty() ? name(result_.status) : result_.reason;
  return result_.converged();
}

Drive TestWalk::unloaded_drive(double flexion) const {
  TestPose pose;
  pose.flexion = flexion;
  return drive_of(pose, scene_, models_.models[0], bench_.knee().load_factors());
}

void TestWalk::flex_through(const std::vector<double>& flexions,
                            const std::optional<Standing>& start) {
  const auto condition = static_cast<std::size_t>(
      models_.models[0].conditions[static_cast<std::size_t>(scene_.calibration->flexion)]);
  Standing at = start.value_or(Standing());
  std::string reason;
  for (const double flexion : flexions) {
    const double from = at.has_state ? at.solved.values[condition] : flexion;
    if (go(0, at, unloaded_drive(flexion), parts_of(flexion - from, kFlexionStep), reason))
      unloaded_[flexion] = at;
  }
}

/// From the flexion that the scene describes upwards, then downwards.
void TestWalk::flex() {
  const double begin =
      scene_.conditions[static_cast<std::size_t>(scene_.calibration->flexion)].value;
  std::vector<double> up, down;
  for (const TestPose& pose : tests_.poses)
    (pose.flexion < begin ? down : up).push_back(pose.flexion);
  const auto tidy = [](std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  };
  tidy(up);
  tidy(down);
  std::reverse(down.begin(), down.end());
  flex_through({begin}, std::nullopt);
  const auto found = unloaded_.find(begin);
  const std::optional<Standing> start =
      found == unloaded_.end() ? std::nullopt : std::optional(found->second);
  flex_through(up, start);
  flex_through(down, start);
}

/// The same pose where that model's condition holds what is there.
Standing TestWalk::held(const Standing& free, std::size_t model, double& value) const {
  const MeasuredModel &from = models_.models[0], &to = models_.models[model];
  Standing standing = free;
  standing.state.sigma.assign(to.model->conditions.size(), 0);
  standing.solved = drive_of(*to.model);
  standing.solved.scales = free.solved.scales;
  for (std::size_t i = 0; i < to.conditions.size(); ++i) {
    if (to.conditions[i] < 0) continue;
    const auto own = static_cast<std::size_t>(to.conditions[i]);
    if (from.conditions[i] >= 0) {
      const auto same = static_cast<std::size_t>(from.conditions[i]);
      standing.state.sigma[own] = free.state.sigma[same];
      standing.solved.values[own] = free.solved.values[same];
    } else {
      value = evaluate(to.model->conditions[own], 0, free.state.X).coordinate;
      standing.solved.values[own] = value;
    }
  }
  return standing;
}

void TestWalk::load() {
  // Curves: one flexion, one load, one way from its unloaded value.
  std::map<std::tuple<double, std::size_t, int, bool>, std::vector<std::size_t>> curves;
  std::map<std::tuple<double, std::size_t>, double> begins;
  for (std::size_t p = 0; p < tests_.poses.size(); ++p) {
    const TestPose& pose = tests_.poses[p];
    const auto free = unloaded_.find(pose.flexion);
    if (free == unloaded_.end()) {
      reached_[p].reason = "the unloaded knee has no equilibrium at that flexion";
    } else if (pose.model == 0 && pose.load < 0) {
      keep(p, free->second);
    } else {
      double begin = 0;
      if (pose.model > 0) (void)held(free->second, pose.model, begin);
      begins[{pose.flexion, pose.model}] = begin;
      curves[{pose.flexion, pose.model, pose.load, pose.level < begin}].push_back(p);
    }
  }
  for (auto& [key, curve] : curves) {
    const double flexion = std::get<0>(key), begin = begins[{flexion, std::get<1>(key)}];
    if (std::get<3>(key)) std::reverse(curve.begin(), curve.end());
    load_along(curve, unloaded_.at(flexion), begin);
  }
}

/// `curve`: poses in the order of their distance from `begin`.
void TestWalk::load_along(const std::vector<std::size_t>& curve,
                          const Standing& unloaded,
                          double begin) {
  const std::size_t model = tests_.poses[curve.front()].model;
  double unused = 0;
  Standing at = model > 0 ? held(unloaded, model, unused) : unloaded;
  const double step = kLoadStep * std::abs(tests_.poses[curve.back()].level - begin);
  double level = begin;
  for (const std::size_t p : curve) {
    const double next = tests_.poses[p].level;
    if (go(model, at, bench_.drive(p), parts_of(next - level, step), reached_[p].reason))
      keep(p, at);
    level = next;
  }
}

void TestWalk::mend() {
  for (std::size_t p = 0; p < tests_.poses.size(); ++p) {
    if (reached_[p].standing) continue;
    const TestPose& pose = tests_.poses[p];
    std::optional<std::size_t> nearest;
    const auto away = [&](std::size_t q) {
      return std::abs(tests_.poses[q].flexion - pose.flexion);
    };
    for (std::size_t q = 0; q < tests_.poses.size(); ++q) {
      const TestPose& other = tests_.poses[q];
      const bool alike = other.model == pose.model && other.load == pose.load &&
                         other.level == pose.level && reached_[q].standing;
      if (alike && (!nearest || away(q) < away(*nearest))) nearest = q;
    }
    // Where the knee has no equilibrium without its load, the start pose is as good as any.
    Standing at = nearest ? *reached_[*nearest].standing : Standing();
    const int parts = nearest ? parts_of(away(*nearest), kFlexionStep) : 1;
    std::string reason;
    if (go(pose.model, at, bench_.drive(p), parts, reason))
      keep(p, at);
    else if (!reason.empty())
      reached_[p].reason = reason;
  }
}

}  // namespace

std::vector<ReachedPose> walk_to_tests(const Scene& scene,
                                       const MeasuredModels& models,
                                       const TestPoses& tests,
                                       TestBench& bench) {
  return TestWalk(scene, models, tests, bench).walk();
}

}  // namespace condyle
