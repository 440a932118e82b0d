/// What a wrapped strand costs in one Newton iteration: its ends a little further than at the call
/// before, the path warm, wrench and blocks included. Argument: minus the power of ten of the step [mm].
/// And what the wrapped strands of a whole scene cost in a warm pose.

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>

#include "condyle/equilibrium/build_model.h"
#include "condyle/equilibrium/equilibrium_solver.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/specimen/fit_surfaces.h"
#include "condyle/wrapping/wrapped_path.h"

namespace condyle::benchmarks {
namespace {

const Eigen::Vector3d kX(-24, 20, 3), kY(22, -6, 15);

void warm_pull(benchmark::State& state,
               const std::vector<PathWrap>& wraps,
               const Eigen::Vector3d& x_C = kX,
               const Eigen::Vector3d& s_D = kY) {
  const double step = std::pow(10.0, -static_cast<double>(state.range(0)));
  const auto path = make_wrapped_path(wraps, x_C, s_D);
  auto kept = unknown_path();
  RigidTransform X;
  Wrench unit;
  double L = 0, sign = 1;
  for (auto _ : state) {
    sign = -sign;
    X.p = Eigen::Vector3d(sign * step, -sign * step, sign * step);
    L = path->pull({x_C, X.p + s_D, s_D}, X, kept.data(), unit);
    benchmark::DoNotOptimize(unit);
  }
  if (!path->touches({x_C, X.p + s_D, s_D}, X, kept.data()).at(0).touching)
    state.SkipWithError("it does not touch");
  state.counters["length"] = L;
}

std::vector<PathWrap> one(const WrapShape& shape, bool on_A = false) {
  return {{"surface", shape, {}, on_A, {}}};
}

BENCHMARK_CAPTURE(warm_pull, sphere, one(WrapSphere{14}))->Arg(1)->Arg(4);
BENCHMARK_CAPTURE(warm_pull, cylinder, one(WrapCylinder{13}))->Arg(1)->Arg(4);
BENCHMARK_CAPTURE(warm_pull, ellipsoid, one(WrapEllipsoid{{30, 18, 12}}))->Arg(1)->Arg(3)->Arg(6);
BENCHMARK_CAPTURE(warm_pull, ellipsoid_on_A, one(WrapEllipsoid{{30, 18, 12}}, true))
    ->Arg(1)
    ->Arg(3)
    ->Arg(6);
BENCHMARK_CAPTURE(warm_pull, torus, one(WrapTorus{12, 8}))->Arg(1)->Arg(3)->Arg(6);

const Eigen::Vector3d kInside(-6, 10, 9);
const RigidTransform kBeside{Eigen::Matrix3d::Identity(), {30, -25, 0}};
const std::vector<PathWrap> kTwo = {
    {"first", WrapEllipsoid{{30, 18, 12}}, {}, false, {}},
    {"second", WrapSphere{12}, kBeside, true, Eigen::Vector3d(30, -25, 20)}};

BENCHMARK_CAPTURE(warm_pull, anchored_C, one(WrapEllipsoid{{30, 18, 12}}), kInside, kY)
    ->Arg(1)
    ->Arg(3);
BENCHMARK_CAPTURE(warm_pull, anchored_D, one(WrapEllipsoid{{30, 18, 12}}, true), kY, kInside)
    ->Arg(1)
    ->Arg(3);
BENCHMARK_CAPTURE(warm_pull, two_surfaces, kTwo, kX, Eigen::Vector3d(40, -45, 5))->Arg(1)->Arg(3);

/// A pose of the scene that CONDYLE_SCENE names, contacts rigid, the first condition from 0 to 120 degrees by
/// 5 and back; without its wraps all strands are straight.
void scene_pose(benchmark::State& state) {
  const char* file = std::getenv("CONDYLE_SCENE");
  if (file == nullptr) return state.SkipWithError("CONDYLE_SCENE names no scene");
  Scene scene = read_scene(file);
  for (ContactDescription& contact : scene.contacts) contact.layer.reset();
  if (state.range(0) == 0)
    for (LigamentDescription& ligament : scene.ligaments) ligament.path.wraps.clear();
  EquilibriumSolver solver(build_model(scene, fit_surfaces(scene)));
  Drive drive = drive_of(solver.model());
  PoseResult result;
  long poses = 0;
  const auto next = [&] {
    constexpr int kSteps = 24;
    const int phase = static_cast<int>(poses++ % (2 * kSteps));
    drive.values.at(0) = (phase <= kSteps ? phase : 2 * kSteps - phase) * M_PI / 36;
    solver.solve(drive, result);
  };
  for (int warm = 0; warm < 48; ++warm) next();
  for (auto _ : state) {
    next();
    if (!result.converged()) return state.SkipWithError(result.reason.c_str());
  }
}
BENCHMARK(scene_pose)->ArgName("wraps")->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace condyle::benchmarks
