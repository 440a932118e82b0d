#include "condyle/results/study_reduction.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "condyle/equilibrium/pose_output.h"
#include "condyle/math/no_number.h"
#include "condyle/results/study_groups.h"
#include "condyle/study/summarise.h"

namespace condyle {
namespace {

using Theta = std::vector<std::vector<double>>;

template <class Number>
std::vector<Number> slice(const std::vector<Number>& all, std::size_t from, std::size_t count) {
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(from);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

/// The groups that tell of some samples.
struct SummaryGroups {
  Hdf5Group bands, indices, failures;
};

SummaryGroups make_groups(const Hdf5Group& parent) {
  SummaryGroups groups{parent.create("bands"), parent.create("indices"), parent.create("failures")};
  groups.bands.write_attribute("levels", fmt::format("{}", fmt::join(kBandLevels, ", ")));
  return groups;
}

SummaryGroups open_groups(const Hdf5Group& parent) {
  return {parent.open("bands"), parent.open("indices"), parent.open("failures")};
}

std::vector<double> nominal_values(const StudyPlan& plan,
                                   const StudyOutput& output,
                                   const SweepResult& sweep) {
  std::vector<double> values(plan.values.size(), kNoNumber);
  for (std::size_t p = 0; p < values.size() && p < sweep.poses.size(); ++p)
    if (sweep.poses[p].converged())
      values[p] = value_of(output.output, sweep.poses[p]) / output.unit.factor;
  return values;
}

/// Mean over the knees that have the value.
std::vector<double> mean_of(const std::vector<std::vector<double>>& rows) {
  std::vector<double> mean(rows.front().size());
  for (std::size_t p = 0; p < mean.size(); ++p) {
    int count = 0;
    for (const std::vector<double>& row : rows) {
      if (std::isnan(row[p])) continue;
      mean[p] += row[p];
      ++count;
    }
    mean[p] /= count;
  }
  return mean;
}

/// What varies of one knee.
Theta theta_of(const Theta& theta, std::size_t from, std::size_t count) {
  Theta part;
  for (const std::vector<double>& column : theta) part.push_back(slice(column, from, count));
  return part;
}

class Reduction {
 public:
  Reduction(const Hdf5Group& root, const StudyPlan& plan, const Theta& theta, int threads)
      : root_(root),
        outputs_(root.open("outputs")),
        plan_(plan),
        theta_(theta),
        threads_(threads),
        poses_(plan.values.size()),
        by_knee_(plan.knees.size() > 1 && plan.points > 1) {
    ranked_ = ranked_parameters(theta, saltelli() && plan.knees.size() == 1);
    for (std::size_t k = 0; by_knee_ && k < plan.knees.size(); ++k)
      ranked_by_knee_.push_back(
          ranked_parameters(theta_of(theta, k * plan.points, plan.points), saltelli()));
    (void)make_groups(root);
    if (!by_knee_) return;
    const Hdf5Group knees = root.create("knees");
    for (const std::string& name : names_ = knee_names(plan)) (void)make_groups(knees.create(name));
  }

  void add_output(const StudyOutput& output,
                  const std::vector<const SweepResult*>& nominal,
                  StudySummary& summary) const {
    const std::vector<double> column = outputs_.read(output.name, {plan_.samples(), poses_});
    std::vector<std::vector<double>> rows;
    const std::size_t o = summary.bands.size();
    for (std::size_t k = 0; k < nominal.size(); ++k)
      rows.push_back(nominal_values(plan_, plan_.knees[k].outputs[o], *nominal[k]));
    const OutputSamples samples{column, poses_};
    summary.bands.push_back(study_band(samples, mean_of(rows), threads_));
    summary.effects.push_back(study_effects(samples, ranked_, threads_));
    write(open_groups(root_), output, summary.bands.back(), summary.effects.back());
    for (std::size_t k = 0; by_knee_ && k < plan_.knees.size(); ++k) {
      const std::vector<double> own =
          slice(column, k * plan_.points * poses_, plan_.points * poses_);
      const OutputSamples of_knee{own, poses_};
      write(open_groups(root_.open("knees").open(names_[k])), output,
            study_band(of_knee, rows[k], threads_),
            study_effects(of_knee, ranked_by_knee_[k], threads_));
    }
  }

  [[nodiscard]] StudyFailures add_failures() const {
    const std::vector<double> read = outputs_.read("status", {plan_.samples(), poses_});
    const std::vector<std::uint8_t> status(read.begin(), read.end());
    StudyFailures all = study_failures(status, poses_, theta_, saltelli());
    write_failures(root_.open("failures"), all);
    for (std::size_t k = 0; by_knee_ && k < plan_.knees.size(); ++k)
      write_failures(
          root_.open("knees").open(names_[k]).open("failures"),
          study_failures(slice(status, k * plan_.points * poses_, plan_.points * poses_), poses_,
                         theta_of(theta_, k * plan_.points, plan_.points), saltelli()));
    return all;
  }

 private:
  [[nodiscard]] bool saltelli() const { return plan_.study.design == DesignKind::kSaltelli; }

  static void write(const SummaryGroups& groups,
                    const StudyOutput& output,
                    const StudyBand& band,
                    const StudyEffects& effects) {
    write_band(groups.bands, output.name, band, output.unit.name);
    write_effects(groups.indices, output.name, effects);
  }

  const Hdf5Group& root_;
  Hdf5Group outputs_;
  const StudyPlan& plan_;
  const Theta& theta_;
  int threads_ = 1;
  std::size_t poses_ = 0;
  bool by_knee_ = false;
  RankedParameters ranked_;
  std::vector<RankedParameters> ranked_by_knee_;
  std::vector<std::string> names_;
};

}  // namespace

std::vector<std::string> knee_names(const StudyPlan& plan) {
  std::vector<std::string> names;
  std::set<std::string> taken;
  for (const StudyKnee& knee : plan.knees) {
    std::string name = knee.name;
    for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{}.{}", knee.name, i);
    names.push_back(name);
  }
  return names;
}

StudySummary write_summaries(const Hdf5Group& root,
                             const StudyPlan& plan,
                             const std::vector<std::vector<double>>& theta,
                             const std::vector<const SweepResult*>& nominal,
                             int threads,
                             const OnProgress& on_output) {
  StudySummary summary;
  const Reduction reduction(root, plan, theta, threads);
  const int total = static_cast<int>(plan.outputs.size());
  for (const StudyOutput& output : plan.outputs) {
    reduction.add_output(output, nominal, summary);
    if (on_output) on_output(static_cast<int>(summary.bands.size()), total);
  }
  summary.failures = reduction.add_failures();
  return summary;
}

}  // namespace condyle
