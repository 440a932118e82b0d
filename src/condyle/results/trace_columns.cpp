#include "condyle/results/trace_columns.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "condyle/math/no_number.h"

namespace condyle {
namespace {

using Poses = std::vector<PoseResult>;

struct CountColumn {
  const char* name;
  int PoseTrace::*member;
};

constexpr std::array<CountColumn, 4> kCounts = {{{"parts", &PoseTrace::parts},
                                                 {"searches", &PoseTrace::searches},
                                                 {"closings", &PoseTrace::closings},
                                                 {"openings", &PoseTrace::openings}}};

/// An enumeration of a trace, its names in the attribute `meaning`.
template <typename Enum>
void write_names(const Hdf5Group& sweep,
                 const char* dataset,
                 const Poses& poses,
                 Enum PoseTrace::*member,
                 int count) {
  std::vector<int> values;
  std::vector<std::string> meanings;
  for (const PoseResult& pose : poses) values.push_back(static_cast<int>(pose.trace.*member));
  for (int k = 0; k < count; ++k) meanings.emplace_back(name(static_cast<Enum>(k)));
  sweep.write(dataset, values, {poses.size()}, "1");
  sweep.write_attribute(dataset, "meaning", meanings);
}

template <typename Enum>
void read_names(
    const Hdf5Group& sweep, const char* dataset, Poses& poses, Enum PoseTrace::*member, int count) {
  const std::vector<int> values = sweep.read_integers(dataset, {poses.size()});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (values[i] < 0 || values[i] >= count)
      sweep.fail(std::string(dataset) + " = " + std::to_string(values[i]) +
                 ", which has no meaning");
    poses[i].trace.*member = static_cast<Enum>(values[i]);
  }
}

void write_history(const Hdf5Group& newton, const Poses& poses) {
  std::size_t width = 1;
  for (const PoseResult& pose : poses)
    width = std::max(width, static_cast<std::size_t>(pose.trace.residuals.size()));
  std::vector<double> rows(poses.size() * width, kNoNumber);
  for (std::size_t i = 0; i < poses.size(); ++i)
    std::copy(poses[i].trace.residuals.begin(), poses[i].trace.residuals.end(), &rows[i * width]);
  newton.write("history", rows, {poses.size(), width}, "1");
}

void read_history(const Hdf5Group& newton, Poses& poses) {
  const Hdf5Array history = newton.read("history");
  if (history.shape.size() != 2 || history.shape[0] != poses.size())
    newton.fail("dataset history has not one row for each pose");
  const std::size_t width = history.shape[1];
  for (std::size_t i = 0; i < poses.size(); ++i)
    for (std::size_t k = 0; k < width && !std::isnan(history.values[i * width + k]); ++k)
      poses[i].trace.residuals.add(history.values[i * width + k]);
}

}  // namespace

void write_traces(const Hdf5Group& sweep, const Hdf5Group& newton, const Poses& poses) {
  const bool told = std::any_of(poses.begin(), poses.end(),
                                [](const PoseResult& pose) { return pose.trace.told(); });
  if (!told) return;
  write_names(sweep, "route", poses, &PoseTrace::route, kPoseRouteCount);
  write_names(sweep, "route_from", poses, &PoseTrace::origin, kPoseOriginCount);
  write_history(newton, poses);
  for (const CountColumn& column : kCounts) {
    std::vector<int> counts;
    for (const PoseResult& pose : poses) counts.push_back(pose.trace.*column.member);
    newton.write(column.name, counts, {poses.size()}, "1");
  }
}

void read_traces(const Hdf5Group& sweep, const Hdf5Group& newton, Poses& poses) {
  if (!sweep.has("route")) return;
  read_names(sweep, "route", poses, &PoseTrace::route, kPoseRouteCount);
  read_names(sweep, "route_from", poses, &PoseTrace::origin, kPoseOriginCount);
  read_history(newton, poses);
  for (const CountColumn& column : kCounts) {
    const std::vector<int> counts = newton.read_integers(column.name, {poses.size()});
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i].trace.*column.member = counts[i];
  }
}

}  // namespace condyle
