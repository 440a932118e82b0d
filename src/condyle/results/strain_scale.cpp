#include "condyle/results/strain_scale.h"

#include <algorithm>
#include <cmath>

#include "condyle/results/run_view.h"

namespace condyle {

StrainScale strain_scale(const Run& run) {
  StrainScale scale;
  for (const PoseResult& pose : run.sweep.poses) {
    if (!has_place(pose)) continue;
    for (const LigamentResult& ligament : pose.ligaments)
      scale.greatest = std::max(scale.greatest, ligament.strain);
  }
  scale.top = std::min(kPhysiologicalStrain, round_up_nicely(scale.greatest));
  return scale;
}

double round_up_nicely(double x) {
  const double decade = std::pow(10.0, std::floor(std::log10(x)));
  for (const double step : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (x <= step * decade * (1 + 1e-9)) return step * decade;
  }
  return 10 * decade;
}

}  // namespace condyle
