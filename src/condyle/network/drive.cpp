#include "condyle/network/drive.h"

#include <algorithm>
#include <cmath>

namespace condyle {
namespace {

/// Straight between the points, constant beyond them.
double from_table(const DriveDescription& drive, double t) {
  const auto after = std::upper_bound(drive.times.begin(), drive.times.end(), t);
  if (after == drive.times.begin()) return drive.factors.front();
  if (after == drive.times.end()) return drive.factors.back();
  const auto i = static_cast<std::size_t>(after - drive.times.begin());
  const double part = (t - drive.times[i - 1]) / (drive.times[i] - drive.times[i - 1]);
  return drive.factors[i - 1] + part * (drive.factors[i] - drive.factors[i - 1]);
}

double factor_at(const DriveDescription& drive, double t) {
  const double since = t - drive.start;
  switch (drive.shape) {
    case DriveDescription::Shape::kPulse:
      return since >= 0 && t < drive.start + drive.duration ? 1 : 0;
    case DriveDescription::Shape::kDecayingSine:
      return since < 0
                 ? 0
                 : std::exp(-drive.decay * since) * std::sin(2 * M_PI * drive.frequency * since);
    default:
      return from_table(drive, t);
  }
}

}  // namespace

double load_scale_at(const std::vector<DriveDescription>& drives,
                     int load,
                     double t,
                     double otherwise) {
  bool driven = false;
  double scale = 0;
  for (const DriveDescription& drive : drives) {
    if (drive.load != load) continue;
    driven = true;
    scale += factor_at(drive, t);
  }
  return driven ? scale : otherwise;
}

std::vector<double> drive_breaks(const std::vector<DriveDescription>& drives) {
  std::vector<double> breaks;
  for (const DriveDescription& drive : drives) {
    if (drive.shape == DriveDescription::Shape::kTable) {
      breaks.insert(breaks.end(), drive.times.begin(), drive.times.end());
      continue;
    }
    breaks.push_back(drive.start);
    if (drive.shape == DriveDescription::Shape::kPulse)
      breaks.push_back(drive.start + drive.duration);
  }
  return breaks;
}

}  // namespace condyle
