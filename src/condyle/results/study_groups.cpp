#include "condyle/results/study_groups.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "condyle/contact/pose_status.h"

namespace condyle {
namespace {

constexpr std::size_t kStatuses = 16, kQuarters = 4, kLevels = kBandLevels.size();

std::vector<int> whole_numbers(const std::vector<long>& numbers) {
  return {numbers.begin(), numbers.end()};
}

std::vector<long> long_numbers(const std::vector<int>& numbers) {
  return {numbers.begin(), numbers.end()};
}

template <class Rows>
auto joined(const Rows& rows) {
  std::vector<typename Rows::value_type::value_type> all;
  for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
  return all;
}

using Estimates = std::vector<std::vector<IndexEstimate>>;

void write_estimates(const Hdf5Group& group, const char* name, const Estimates& estimates) {
  if (estimates.empty()) return;
  std::vector<double> values;
  for (const IndexEstimate& e : joined(estimates))
    values.insert(values.end(), {e.value, e.lower, e.upper});
  group.write(name, values, {estimates.size(), estimates[0].size(), 3}, "1");
}

Estimates read_estimates(const Hdf5Group& group,
                         const char* name,
                         std::size_t parameters,
                         std::size_t poses) {
  if (!group.has(name)) return {};
  const std::vector<double> values = group.read(name, {parameters, poses, 3});
  Estimates estimates(parameters, std::vector<IndexEstimate>(poses));
  const double* at = values.data();
  for (std::vector<IndexEstimate>& row : estimates)
    for (IndexEstimate& e : row) {
      e = {at[0], at[1], at[2]};
      at += 3;
    }
  return estimates;
}

std::vector<std::string> meanings_of_status() {
  std::vector<std::string> meanings;
  for (int i = 0; i < kPoseStatusCount; ++i)
    meanings.emplace_back(name(static_cast<PoseStatus>(i)));
  return meanings;
}

long count_in(const Hdf5Group& group, const char* name) {
  constexpr double kMost = 0x1p53;  // samples of a study (read_study.cpp)
  const double count = group.read(name, {1}).front();
  if (!(count >= 0 && count <= kMost && std::trunc(count) == count))
    group.fail(fmt::format("dataset {} is {}, expected a whole number of poses", name, count));
  return static_cast<long>(count);
}

}  // namespace

void write_band(const Hdf5Group& bands,
                const std::string& output,
                const StudyBand& band,
                const std::string& units) {
  const Hdf5Group group = bands.create(output);
  const std::size_t n = band.mean.size();
  group.write("mean", band.mean, {n}, units);
  group.write("sd", band.sd, {n}, units);
  group.write("nominal", band.nominal, {n}, units);
  group.write("quantiles", joined(band.quantiles), {kLevels, n}, units);
  group.write("samples", whole_numbers(band.samples), {n}, "1");
}

StudyBand read_band(const Hdf5Group& bands, const std::string& output, std::size_t poses) {
  const Hdf5Group group = bands.open(output);
  StudyBand band;
  band.mean = group.read("mean", {poses});
  band.sd = group.read("sd", {poses});
  band.nominal = group.read("nominal", {poses});
  const std::vector<double> quantiles = group.read("quantiles", {kLevels, poses});
  for (std::size_t q = 0; q < kLevels; ++q) {
    const double* row = quantiles.data() + q * poses;
    band.quantiles[q].assign(row, row + poses);
  }
  band.samples = long_numbers(group.read_integers("samples", {poses}));
  return band;
}

void write_effects(const Hdf5Group& indices,
                   const std::string& output,
                   const StudyEffects& effects) {
  const Hdf5Group group = indices.create(output);
  write_estimates(group, "first", effects.first);
  write_estimates(group, "total", effects.total);
  if (!effects.rank.empty())
    group.write("rank", joined(effects.rank), {effects.rank.size(), effects.rank[0].size()}, "1");
}

StudyEffects read_effects(const Hdf5Group& indices,
                          const std::string& output,
                          std::size_t parameters,
                          std::size_t poses) {
  const Hdf5Group group = indices.open(output);
  StudyEffects effects;
  effects.first = read_estimates(group, "first", parameters, poses);
  effects.total = read_estimates(group, "total", parameters, poses);
  if (effects.first.size() != effects.total.size())
    group.fail("holds one of first and total, expected both or none");
  if (!group.has("rank")) return effects;
  const std::vector<double> rank = group.read("rank", {parameters, poses});
  for (std::size_t i = 0; i < parameters; ++i)
    effects.rank.emplace_back(rank.data() + i * poses, rank.data() + (i + 1) * poses);
  return effects;
}

void write_failures(const Hdf5Group& group, const StudyFailures& failures) {
  const auto count = [&](const char* name, long number) {
    group.write(name, std::vector<double>{static_cast<double>(number)}, {1}, "1");
  };
  count("poses", failures.poses);
  count("failed", failures.failed);
  count("incomplete", failures.incomplete);
  group.write("by_pose", whole_numbers(failures.by_pose), {failures.by_pose.size()}, "1");
  group.write("by_status", whole_numbers(joined(failures.by_status)),
              {failures.by_status.size(), kStatuses}, "1");
  group.write_attribute("by_status", "meaning", meanings_of_status());
  group.write("by_quartile", joined(failures.by_quartile), {failures.by_quartile.size(), kQuarters},
              "1");
}

StudyFailures read_failures(const Hdf5Group& group, std::size_t parameters, std::size_t poses) {
  StudyFailures failures;
  failures.poses = count_in(group, "poses");
  failures.failed = count_in(group, "failed");
  failures.incomplete = count_in(group, "incomplete");
  failures.by_pose = long_numbers(group.read_integers("by_pose", {poses}));
  const std::vector<int> statuses = group.read_integers("by_status", {poses, kStatuses});
  failures.by_status.resize(poses);
  for (std::size_t p = 0; p < poses; ++p)
    std::copy_n(statuses.begin() + static_cast<long>(p * kStatuses), kStatuses,
                failures.by_status[p].begin());
  const std::vector<double> rates = group.read("by_quartile", {parameters, kQuarters});
  failures.by_quartile.resize(parameters);
  for (std::size_t i = 0; i < parameters; ++i)
    std::copy_n(rates.begin() + static_cast<long>(i * kQuarters), kQuarters,
                failures.by_quartile[i].begin());
  return failures;
}

}  // namespace condyle
