#include "phantom/roughness.h"

#include <cmath>

namespace condyle::phantom {

namespace {

/// A small generator of its own, so that the field does not depend on a standard library [Steele
/// 2014, splitmix64].
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// Uniform in (0, 1).
  double uniform() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    z ^= z >> 31;
    return (static_cast<double>(z >> 11) + 0.5) * 0x1.0p-53;
  }
  /// Standard normal (Box and Muller).
  double normal() { return std::sqrt(-2 * std::log(uniform())) * std::cos(2 * kPi * uniform()); }
  static constexpr double kPi = 3.14159265358979323846;

 private:
  std::uint64_t state_;
};

}  // namespace

void roughen(Bone bone,
             const Roughness& roughness,
             TriangleMesh& mesh,
             const PhantomParameters& knee) {
  if (roughness.rms <= 0 || mesh.vertices.empty()) return;
  // A sum of many plane waves, wave vectors normally distributed with deviation 1/l: correlation
  // exp(-d²/2l²).
  constexpr int kWaves = 800;
  Random random(roughness.seed * 2 + (bone == Bone::kFemur ? 0 : 1));
  Eigen::Matrix<double, Eigen::Dynamic, 3> k(kWaves, 3);
  Eigen::ArrayXd phase(kWaves);
  for (int w = 0; w < kWaves; ++w) {
    for (int a = 0; a < 3; ++a) k(w, a) = random.normal() / roughness.correlation;
    phase[w] = 2 * Random::kPi * random.uniform();
  }
  std::vector<double> field(mesh.vertices.size());
  double sum = 0, sum_of_squares = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    double value = 0;
    for (int w = 0; w < kWaves; ++w) value += std::cos(k.row(w).dot(mesh.vertices[i]) + phase[w]);
    field[i] = value;
    sum += value;
    sum_of_squares += value * value;
  }
  const double n = static_cast<double>(field.size()), mean = sum / n;
  const double scale = roughness.rms / std::sqrt(sum_of_squares / n - mean * mean);
  for (std::size_t i = 0; i < field.size(); ++i)
    mesh.vertices[i] += scale * (field[i] - mean) * normal(bone, mesh.vertices[i], knee);
}

}  // namespace condyle::phantom
