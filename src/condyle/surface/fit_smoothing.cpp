#include "condyle/surface/fit_smoothing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "condyle/surface/patch.h"

namespace condyle {
namespace {

using Eigen::VectorXd;

constexpr int kRungs = 9;          // smoothing lengths that are tried
constexpr int kCorrelations = 12;  // correlation lengths that are tried
constexpr double kNear = 1.02;     // an error of normals over the least one that is as good
// Of segmentations, and the spread of its logarithm: where the bands do not tell, it decides.
constexpr double kUsualCorrelation = 1.2, kUsualSpread = 0.7;  // [mm], [-]

/// A wave of wave number k as a fit passes it.
double passed(double smoothing_length, double k) {
  const double x = smoothing_length * k, cube = x * x * x;
  return 1 / (1 + cube * cube);
}

/// What an error of wave number k counts for.
double worth(SmoothingAim aim, double k) { return aim == SmoothingAim::kNormals ? k * k : 1; }

/// (1/2π) ∫ S(k) weight(k) k dk for texture of unit variance and correlation length l.
template <class Weight>
double over_spectrum(double l, Weight weight) {
  constexpr int kSteps = 120;
  const double last = 5 / l, step = last / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double k = (i + 0.5) * step;
    sum += l * l * std::exp(-k * k * l * l / 2) * weight(k) * k * step;
  }
  return sum;
}

/// Fits of growing smoothing length, and how far the judged points lie from each of them.
struct Ladder {
  SmoothingAim aim = SmoothingAim::kNormals;
  std::vector<double> length;  ///< [mm]
  std::vector<VectorXd> left;  ///< distances at right angles [mm]
  VectorXd weight;             ///< of the points, sum 1
  double area = 0;             ///< mean of a point [mm²]

  /// Fractions of the smoothing length and the share of the judged area where they hold.
  std::vector<std::array<double, 2>> fractions;

  [[nodiscard]] double mean_square(const VectorXd& v) const { return weight.dot(v.cwiseAbs2()); }
};

VectorXd distances(const SplineGrid& grid,
                   const std::vector<DataPoint>& points,
                   const DataTerm& data,
                   const PenaltyTerm& penalty,
                   double smoothing_length) {
  const Patch patch(patch_data(grid, solve_fit(data, penalty, smoothing_length)));
  VectorXd left(static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PatchDerivatives d = patch.derivatives(points[i].uv.x(), points[i].uv.y());
    left[static_cast<Eigen::Index>(i)] =
        d.c_u.cross(d.c_v).stableNormalized().dot(points[i].p - d.c);
  }
  return left;
}

void weigh(const std::vector<DataPoint>& points,
           const std::vector<Judgement>& judged,
           Ladder& ladder) {
  constexpr int kBins = 6;
  std::array<double, kBins> share{};
  ladder.weight.setZero(static_cast<Eigen::Index>(points.size()));
  double sum = 0, area = 0, count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!judged[i].counts) continue;
    const double weight = points[i].weight * judged[i].weight;
    ladder.weight[static_cast<Eigen::Index>(i)] = weight;
    sum += weight;
    area += points[i].weight;
    ++count;
    const int bin = static_cast<int>(std::lround(judged[i].smoothing * kBins)) - 1;
    share[std::clamp(bin, 0, kBins - 1)] += weight;
  }
  ladder.weight /= std::max(sum, 1e-300);
  ladder.area = area / std::max(count, 1.0);
  for (int b = 0; b < kBins; ++b)
    if (share[b] > 0) ladder.fractions.push_back({(b + 1.0) / kBins, share[b] / sum});
}

Ladder climb(const SplineGrid& grid,
             const std::vector<DataPoint>& points,
             const std::vector<Judgement>& judged,
             const PenaltyTerm& penalty,
             const SmoothingOptions& options) {
  Ladder ladder;
  ladder.aim = options.aim;
  weigh(points, judged, ladder);
  const DataTerm data = assemble_data(grid, points);
  for (int r = 0; r < kRungs; ++r) {
    ladder.length.push_back(options.least *
                            std::pow(options.greatest / options.least, r / (kRungs - 1.0)));
    ladder.left.push_back(distances(grid, points, data, penalty, ladder.length.back()));
  }
  return ladder;
}

/// Power between a rung and the one before it (band 0: beside the first rung), in the data and in
/// unit texture of correlation length l.
std::vector<double> bands_of_data(const Ladder& ladder) {
  std::vector<double> bands;
  for (std::size_t r = 0; r < ladder.left.size(); ++r)
    bands.push_back(r == 0 ? ladder.mean_square(ladder.left[0])
                           : ladder.mean_square(ladder.left[r] - ladder.left[r - 1]));
  return bands;
}
std::vector<double> bands_of_texture(const Ladder& ladder, double l) {
  std::vector<double> bands;
  for (std::size_t r = 0; r < ladder.length.size(); ++r) {
    double sum = 0;
    for (const auto& [fraction, share] : ladder.fractions)
      sum += share * over_spectrum(l, [&, fraction = fraction](double k) {
               const double above = r == 0 ? 1 : passed(fraction * ladder.length[r - 1], k);
               const double part = above - passed(fraction * ladder.length[r], k);
               return part * part;
             });
    bands.push_back(sum);
  }
  return bands;
}

/// Squared error that unit texture leaves in a fit, which follows it.
double texture_followed(const Ladder& ladder, double length, double l) {
  double sum = 0;
  for (const auto& [fraction, share] : ladder.fractions)
    sum += share * over_spectrum(l, [&, fraction = fraction](double k) {
             const double part = passed(fraction * length, k);
             return part * part * worth(ladder.aim, k);
           });
  return sum;
}

/// Power of texture and of shape, σ² texture + shape · growth^band, that explain the bands best.
struct Explanation {
  double variance = 0, correlation = 0;
  double shape = 0, growth = 0;
  double misfit = 1e300;
};
Explanation explain(const std::vector<double>& data,
                    const std::vector<double>& texture,
                    double growth) {
  constexpr double kFirst = 10;  // band 0 holds the most waves and is known best
  const int n = static_cast<int>(data.size());
  constexpr double kUsual = 0.7;  // misfit of a logarithm beyond which a band loses its say
  const double none = 1e-12;
  Explanation e;
  e.growth = growth;
  // From below: a band that holds much more than the rest explains must not pull.
  e.variance = e.shape = 1e300;
  for (int b = 0; b < n; ++b) {
    e.variance = std::min(e.variance, data[b] / (texture[b] + none));
    e.shape = std::min(e.shape, data[b] / std::pow(growth, b));
  }
  const auto model = [&](int b) {
    return e.variance * texture[b] + e.shape * std::pow(growth, b) + none;
  };
  const auto weight = [&](int b) {
    const double off = std::log((data[b] + none) / model(b));
    return (b == 0 ? kFirst : 1) / (1 + off * off / (kUsual * kUsual));
  };
  for (int iteration = 0; iteration < 60; ++iteration) {
    // Multiplicative steps downhill on Σ w (data/model + log model) keep both positive.
    double up = 0, down = 0, up_shape = 0, down_shape = 0;
    for (int b = 0; b < n; ++b) {
      const double w = weight(b) / model(b), s = std::pow(growth, b);
      up += w * texture[b] * data[b] / model(b), down += w * texture[b];
      up_shape += w * s * data[b] / model(b), down_shape += w * s;
    }
    e.variance *= std::sqrt(up / down);
    e.shape *= std::sqrt(up_shape / down_shape);
  }
  e.misfit = 0;
  for (int b = 0; b < n; ++b) {
    const double off = std::log((data[b] + none) / model(b));
    e.misfit += (b == 0 ? kFirst : 1) * kUsual * kUsual * std::log1p(off * off / (kUsual * kUsual));
  }
  return e;
}

/// All that were tried, the likeliest first.
std::vector<Explanation> explain(const Ladder& ladder) {
  const std::vector<double> data = bands_of_data(ladder);
  // Finer than the mesh is the same as independent from vertex to vertex.
  const double finest = std::sqrt(ladder.area / (2 * M_PI)), coarsest = std::max(4.0, finest);
  std::vector<Explanation> all;
  for (int c = 0; c < kCorrelations; ++c) {
    const double l = finest * std::pow(coarsest / finest, c / (kCorrelations - 1.0));
    const std::vector<double> texture = bands_of_texture(ladder, l);
    for (double growth = 2.2; growth < 12; growth *= 1.3) {
      Explanation e = explain(data, texture, growth);
      e.correlation = l;
      const double unusual = std::log(l / kUsualCorrelation) / kUsualSpread;
      e.misfit += unusual * unusual / 2;
      all.push_back(e);
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Explanation& a, const Explanation& b) { return a.misfit < b.misfit; });
  return all;
}

/// The squared error that a fit of smoothing length ℓ leaves by what it loses of the shape, over
/// what lies between it and the rung before, for a spectrum that falls as the growth of the bands
/// tells: S ~ k^-p, where a band grows with ℓ^(p-2). For normals in units of 1/ℓ².
double lost_over_band(const Ladder& ladder, double growth) {
  const double step = ladder.length[1] / ladder.length[0];
  const double p = 2 + std::log(growth) / std::log(step);
  double lost = 0, band = 0;
  for (double x = -4; x < 5; x += 0.02) {  // over log k, in units of 1/ℓ
    const double k = std::exp(x), power = std::pow(k, 2 - p);
    const double H = passed(1, k), before = passed(1 / step, k);
    lost += power * (1 - H) * (1 - H) * worth(ladder.aim, k);
    band += power * (before - H) * (before - H);
  }
  return lost / band;
}

double density(const Texture& t) { return t.rms * t.rms * t.correlation * t.correlation; }

/// What an explanation takes for texture, no weaker than any segmentation has.
Texture texture_of(const Explanation& e, const SmoothingOptions& options) {
  const Texture found{std::sqrt(e.variance), e.correlation};
  return density(found) < density(options.least_texture) ? options.least_texture : found;
}

/// Expected squared errors at the lengths of a scan.
class Expectation {
 public:
  std::vector<double> errors;

  Expectation(const Ladder& ladder, std::vector<double> lengths)
      : errors(lengths.size()), ladder_(ladder), lengths_(std::move(lengths)) {}

  void add(const Explanation& e, const Texture& texture, double weight) {
    const std::vector<double>& followed = followed_by(texture.correlation);
    const double step = std::log(ladder_.length[1] / ladder_.length[0]);
    const double lost = e.shape * lost_over_band(ladder_, e.growth);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const double band = std::log(lengths_[i] / ladder_.length[0]) / step;
      errors[i] += weight * (texture.rms * texture.rms * followed[i] +
                             lost * std::pow(e.growth, band) * worth(ladder_.aim, 1 / lengths_[i]));
    }
  }

 private:
  const std::vector<double>& followed_by(double correlation) {
    std::vector<double>& followed = followed_[correlation];
    if (followed.empty())
      for (const double length : lengths_)
        followed.push_back(texture_followed(ladder_, length, correlation));
    return followed;
  }

  const Ladder& ladder_;
  std::vector<double> lengths_;
  std::map<double, std::vector<double>> followed_;  ///< by correlation length
};

/// In equal ratios.
std::vector<double> scan(const SmoothingOptions& options, int steps) {
  std::vector<double> lengths;
  for (int i = 0; i <= steps; ++i)
    lengths.push_back(options.least *
                      std::pow(options.greatest / options.least, static_cast<double>(i) / steps));
  return lengths;
}

/// The likeliest explanation's least error, in steps of an eighth: near its least it is flat, and
/// meshes of one bone shall not differ in ℓ.
SmoothingChoice choose_for_positions(const Ladder& ladder,
                                     const std::vector<Explanation>& all,
                                     const SmoothingOptions& options) {
  const std::vector<double> lengths = scan(options, 16);
  const Texture texture = texture_of(all[0], options);
  Expectation expected(ladder, lengths);
  expected.add(all[0], texture, 1);
  const auto least = std::min_element(expected.errors.begin(), expected.errors.end());
  return {lengths[static_cast<std::size_t>(least - expected.errors.begin())], texture,
          std::sqrt(*least)};
}

/// Over all explanations, each as likely as it fits, so that no small change of the data turns the
/// choice over; of the lengths whose error comes near the least the longest, as curvature, which a
/// soft joint feels as well, gets better with ℓ.
SmoothingChoice choose_for_normals(const Ladder& ladder,
                                   const std::vector<Explanation>& all,
                                   const SmoothingOptions& options) {
  constexpr double kUnlikely = 1e-3;
  const std::vector<double> lengths = scan(options, 64);
  Expectation expected(ladder, lengths);
  double likelihood = 0;
  for (const Explanation& e : all) {
    const double weight = std::exp(all[0].misfit - e.misfit);
    if (weight < kUnlikely) break;
    expected.add(e, texture_of(e, options), weight);
    likelihood += weight;
  }
  const std::vector<double>& errors = expected.errors;
  const double least = *std::min_element(errors.begin(), errors.end()),
               limit = kNear * kNear * least;
  std::size_t last = errors.size() - 1;
  while (errors[last] > limit) --last;
  double length = lengths[last];
  if (last + 1 < errors.size())
    length *= std::pow(lengths[last + 1] / lengths[last],
                       (limit - errors[last]) / (errors[last + 1] - errors[last]));
  return {length, texture_of(all[0], options), std::sqrt(least / likelihood)};
}

}  // namespace

SmoothingChoice choose_smoothing(const SplineGrid& grid,
                                 const std::vector<DataPoint>& points,
                                 const std::vector<Judgement>& judged,
                                 const PenaltyTerm& penalty,
                                 const SmoothingOptions& options) {
  assert(judged.size() == points.size());
  const Ladder ladder = climb(grid, points, judged, penalty, options);
  const std::vector<Explanation> all = explain(ladder);
  return options.aim == SmoothingAim::kNormals ? choose_for_normals(ladder, all, options)
                                               : choose_for_positions(ladder, all, options);
}

}  // namespace condyle
