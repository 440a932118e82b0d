/// What a picture costs: the view from the front at 1200 x 900 with 30 thousand triangles of bone,
/// as large on the page and as rough as those of a knee. Compare with docs/pictures.md.

#include <benchmark/benchmark.h>

#include <cmath>

#include "pictures/block_knee.h"
#include "pictures/knee_picture.h"
#include "pictures/png_file.h"

namespace condyle::benchmarks {
namespace {

/// A lumpy ball of 2 n² triangles.
TriangleMesh lump(const Eigen::Vector3d& center, const Eigen::Vector3d& size, int n) {
  TriangleMesh mesh;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double polar = M_PI * i / n, around = 2 * M_PI * j / n;
      const double r = 1 + 0.03 * std::sin(9 * polar) * std::sin(7 * around);
      const Eigen::Vector3d out(std::sin(polar) * std::cos(around), std::cos(polar),
                                -std::sin(polar) * std::sin(around));
      mesh.vertices.push_back(center + r * size.cwiseProduct(out));
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int a = i * n + j, b = i * n + (j + 1) % n;
      mesh.triangles.push_back({a, a + n, b});
      mesh.triangles.push_back({b, a + n, b + n});
    }
  }
  return mesh;
}

Run knee_of_lumps() {
  Run run = block_run();
  constexpr int kRows = 87;  // twice 2 x 87²: 30276 triangles
  run.bodies[0].mesh = lump({0, 41, 0}, {30, 40, 38}, kRows);
  run.bodies[1].mesh = lump({0, -41, 0}, {30, 40, 38}, kRows);
  return run;
}

void picture(benchmark::State& state) {
  const Run run = knee_of_lumps();
  PictureOptions options;
  options.words = state.range(0) != 0;
  KneePictures pictures(run, options);
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
