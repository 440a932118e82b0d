#include "phantom/population.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "condyle/design/normal_draws.h"
#include "phantom/phantom_shape.h"
#include "phantom/tibia.h"

namespace condyle::phantom {

namespace {

constexpr const char* kKapur = "Kapur, 100 femora: read";
constexpr const char* kCheng = "Cheng 2009: read";
constexpr const char* kSixJoints = "six cadaver joints: read";
constexpr const char* kSixJointsOther =
    "six cadaver joints: read of the other condyle, assumed of this";
constexpr const char* kSpheres = "124 knees, CT, less the spread of sizes: derived";
constexpr const char* kCondyleWidth = "Kapur, less the spread of sizes: derived";
constexpr const char* kSlope = "285 knees, MRI: sd read, mean the phantom's";
constexpr const char* kAssumed = "assumed";

// Factors: the published measure over the phantom's own. The other means are the phantom's.
constexpr std::array<MeasureSpread, 18> kSpreads = {{
    {"femur.width", 82.65 / 80.2, 3.96 / 80.2, 72.47 / 80.2, 3.49 / 80.2, "1", kKapur},
    {"femur.depth", 63.28 / 61.2, 4.26 / 61.2, 55.57 / 61.2, 3.60 / 61.2, "1", kKapur},
    {"tibia.width", 76.4 / 74.1, 2.8 / 74.1, 68.8 / 74.1, 4.6 / 74.1, "1", kCheng},
    {"tibia.depth", 51.3 / 49.6, 2.0 / 49.6, 45.7 / 49.6, 1.9 / 49.6, "1", kCheng},
    {"medial.posterior", 1, 0.02, 1, 0.02, "1", kSpheres},
    {"lateral.posterior", 1, 0.05, 1, 0.05, "1", kSpheres},
    {"medial.distal", 1, 2.0 / 30, 1, 2.0 / 30, "1", kSixJoints},
    {"lateral.distal", 1, 4.0 / 26, 1, 4.0 / 26, "1", kSixJoints},
    {"medial.coronal", 1, 2.0 / 20, 1, 2.0 / 20, "1", kSixJoints},
    {"lateral.coronal", 1, 2.0 / 20, 1, 2.0 / 20, "1", kSixJointsOther},
    {"medial.wall", 0, 2.6, 0, 2.6, "mm", kCondyleWidth},
    {"lateral.wall", 0, 2.4, 0, 2.4, "mm", kCondyleWidth},
    {"medial.slope", 7, 3.0, 7, 3.32, "deg", kSlope},
    {"lateral.slope", 6, 3.35, 6, 2.85, "deg", kSlope},
    {"medial.sagittal", 1.0 / 90, 0.003, 1.0 / 90, 0.003, "1/mm", kAssumed},
    {"lateral.sagittal", -1.0 / 45, 0.004, -1.0 / 45, 0.004, "1/mm", kAssumed},
    {"medial.plateau_coronal", 1, 1.3 / 22, 1, 1.3 / 22, "1", kSixJoints},
    {"lateral.plateau_coronal", 1, 1.3 / 22, 1, 1.3 / 22, "1", kSixJointsOther},
}};
constexpr std::size_t kSizes = 4;

}  // namespace

std::span<const MeasureSpread> measure_spreads() { return kSpreads; }

PhantomParameters with_measures(const std::vector<double>& m) {
  PhantomParameters knee;
  knee.femur.size = {.depth = m[1], .width = m[0]};
  knee.tibia.size = {.depth = m[3], .width = m[2]};
  Condyle &medial = knee.femur.medial, &lateral = knee.femur.lateral;
  medial.posterior *= m[4];
  lateral.posterior *= m[5];
  medial.distal *= m[6];
  lateral.distal *= m[7];
  medial.coronal *= m[8];
  lateral.coronal *= m[9];
  medial.wall -= m[10];
  lateral.wall += m[11];
  knee.tibia.medial.slope = std::tan(m[12] * kDegree);
  knee.tibia.lateral.slope = std::tan(m[13] * kDegree);
  knee.tibia.medial.sagittal = 1 / m[14];
  knee.tibia.lateral.sagittal = 1 / m[15];
  knee.tibia.medial.coronal *= m[16];
  knee.tibia.lateral.coronal *= m[17];
  return knee;
}

PopulationKnee population_knee(std::uint64_t seed, std::uint64_t number) {
  const Eigen::VectorXd draws =
      normal_draws(seed, DrawsFor::kPopulation, number, 2 + Eigen::Index(kSpreads.size()));
  PopulationKnee knee;
  knee.woman = draws[0] < 0;
  for (std::size_t i = 0; i < kSpreads.size(); ++i) {
    double z = draws[2 + static_cast<Eigen::Index>(i)];
    if (i < kSizes)
      z = std::sqrt(kSizeCorrelation) * draws[1] + std::sqrt(1 - kSizeCorrelation) * z;
    z = std::clamp(z, -kMostDeviations, kMostDeviations);
    const MeasureSpread& spread = kSpreads[i];
    knee.measures.push_back(knee.woman ? spread.women + z * spread.sd_women
                                       : spread.mean + z * spread.sd);
  }
  knee.parameters = with_closed_compartments(with_measures(knee.measures));
  return knee;
}

double start_gap(const PhantomParameters& knee, int side) {
  // Over the places of the plateau before it is sized, so that a knee sized as a whole has the same ones.
  double gap = std::numeric_limits<double>::infinity();
  for (double x = -15; x <= 22; x += 0.5)
    for (double z = 14; z <= 34; z += 0.5) {
      const Eigen::Vector3d q(x, tibial_height<double>(knee.tibia, x, side * z), side * z);
      gap = std::min(gap, shape(Bone::kFemur, sized(Bone::kTibia, q, knee), knee));
    }
  return gap;
}

PhantomParameters with_closed_compartments(PhantomParameters knee) {
  const double size = knee.femur.size.depth;
  const double medial = size * start_gap(kShippedPhantom, -1),
               lateral = size * start_gap(kShippedPhantom, 1);
  // f is about the distance and the plateaus face upwards: each step leaves about a tenth.
  for (int i = 0; i < 60; ++i) {
    const double rise = start_gap(knee, -1) - medial;
    knee.tibia.rise += rise;
    const double tilt = start_gap(knee, 1) - lateral;
    knee.tibia.lateral.height += tilt / knee.tibia.size.depth;
    if (std::abs(rise) + std::abs(tilt) < 1e-11) break;
  }
  return knee;
}

}  // namespace condyle::phantom
