/// What a picture costs: the view from the front at 1200 x 900 with 30 thousand triangles of bone,
/// as large on the page and as rough as those of a knee. Compare with docs/pictures.md.

#include <benchmark/benchmark.h>

#include <cmath>

#include "condyle/pictures/knee_picture.h"
#include "condyle/pictures/png_file.h"
#include "condyle/pictures/shaded_mesh.h"
#include "support/block_knee.h"

namespace condyle::benchmarks {
namespace {

/// A lumpy ball, closed, of 2 n (n - 1) triangles.
TriangleMesh lump(const Eigen::Vector3d& center, const Eigen::Vector3d& size, int n) {
  TriangleMesh mesh;
  const auto add = [&](double polar, double around) {
    const double r = 1 + 0.03 * std::sin(9 * polar) * std::sin(7 * around);
    const Eigen::Vector3d out(std::sin(polar) * std::cos(around), std::cos(polar),
                              -std::sin(polar) * std::sin(around));
    mesh.vertices.push_back(center + r * size.cwiseProduct(out));
  };
  for (int i = 1; i < n; ++i)
    for (int j = 0; j < n; ++j) add(M_PI * i / n, 2 * M_PI * j / n);
  add(0, 0);
  add(M_PI, 0);
  const int top = n * (n - 1), bottom = top + 1;
  for (int j = 0; j < n; ++j) {
    const int next = (j + 1) % n, last = n * (n - 2);
    mesh.triangles.push_back({top, j, next});
    mesh.triangles.push_back({bottom, last + next, last + j});
    for (int i = 0; i + 2 < n; ++i) {
      const int a = i * n + j, b = i * n + next;
      mesh.triangles.push_back({a, a + n, b});
      mesh.triangles.push_back({b, a + n, b + n});
    }
  }
  return mesh;
}

Run knee_of_lumps() {
  Run run = block_run();
  constexpr int kRows = 88;  // twice 2 x 88 x 87: 30624 triangles
  run.bodies[0].mesh = lump({0, 41, 0}, {30, 40, 38}, kRows);
  run.bodies[1].mesh = lump({0, -41, 0}, {30, 40, 38}, kRows);
  return run;
}

void picture(benchmark::State& state) {
  const Run run = knee_of_lumps();
  PictureOptions options;
  options.words = state.range(0) != 0;
  for (const BodyMesh& bone : run.bodies)
    if (!is_closed(bone.mesh)) return state.SkipWithError("a bone is not closed");
  KneePictures pictures(run, options);
  (void)pictures.draw(View::kAnterior, 0);  // llvmpipe compiles its shaders at their first use
  std::size_t pose = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(pictures.draw(View::kAnterior, pose++ % run.sweep.poses.size()));
}
BENCHMARK(picture)
    ->ArgName("words")
    ->Arg(0)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

void png(benchmark::State& state) {
  const Image image = draw_knee(knee_of_lumps(), View::kAnterior, 0);
  for (auto _ : state) benchmark::DoNotOptimize(encode_png(image));
}
BENCHMARK(png)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace condyle::benchmarks
