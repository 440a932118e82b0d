#include "strangers/stranger_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace condyle::strangers {
namespace {

/// "left patch 3, overlap 1; 2 files not read"
std::string others(const std::vector<Outcome>& outcomes) {
  std::string text;
  for (const auto& [status, count] : count_statuses(outcomes))
    if (status != "converged")
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", status, count);
  int lost = 0;
  for (const Outcome& outcome : outcomes) lost += outcome.error.empty() ? 0 : 1;
  if (lost > 0) text += fmt::format("{}{} sweeps without a result", text.empty() ? "" : ", ", lost);
  return text.empty() ? "-" : text;
}

}  // namespace

std::function<Knee()> reader(const Study::Source& source) {
  return [source] { return read_knee(source.name, source.scene); };
}

void find_knees(Study& study) {
  study.shipped = {{"phantom", study.source / "data/phantom/knee.toml"}};
  const std::filesystem::path specimens = study.source / "../shared/specimens",
                              population = specimens / "clouthier2019_ssm/population";
  const auto add = [&](std::vector<Study::Source>& list, const std::string& name,
                       const std::filesystem::path& file) {
    if (std::filesystem::exists(file))
      list.push_back({name, file});
    else
      study.absent.push_back(name);
  };
  add(study.specimens, "Lenhart 2015", specimens / "lenhart2015/knee.toml");
  add(study.specimens, "Clouthier 2019, mean", specimens / "clouthier2019_ssm/knee.toml");
  if (std::filesystem::exists(specimens / "oai_pymskt"))
    add(study.specimens, "OAI", study.source / "tests/data/oai_pymskt.toml");
  else
    study.absent.emplace_back("OAI");
  if (std::filesystem::exists(population))
    for (const auto& entry : std::filesystem::directory_iterator(population))
      if (entry.path().extension() == ".toml")
        study.population.push_back({entry.path().stem().string(), entry.path()});
  std::sort(study.population.begin(), study.population.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  if (study.population.empty()) study.absent.emplace_back("population");
  if (study.quick) {
    study.population.resize(std::min<std::size_t>(2, study.population.size()));
    study.specimens.resize(std::min<std::size_t>(1, study.specimens.size()));
  }
}

std::vector<Study::Source> Study::all() const {
  std::vector<Source> knees = shipped;
  knees.insert(knees.end(), specimens.begin(), specimens.end());
  knees.insert(knees.end(), population.begin(), population.end());
  return knees;
}

std::vector<Outcome> flat(const Outcomes& outcomes) {
  std::vector<Outcome> list;
  for (const std::vector<Outcome>& job : outcomes) list.insert(list.end(), job.begin(), job.end());
  return list;
}

int sum_false(const std::vector<Outcome>& outcomes) {
  int sum = 0;
  for (const Outcome& outcome : outcomes) sum += outcome.false_poses;
  return sum;
}

Outcomes Study::run(const std::vector<Job>& jobs) {
  Outcomes outcomes = run_jobs(jobs, program, scratch, threads);
  for (const Outcome& outcome : flat(outcomes))
    for (const StrangerPose& pose : outcome.poses)
      if (pose.status != "converged" && pose.seconds > slowest_failing) {
        slowest_failing = pose.seconds;
        slowest = fmt::format("{}, {:.6g} deg, {}", outcome.name, pose.value, pose.status);
      }
  return outcomes;
}

void Study::figure(const std::string& what,
                   const std::string& wanted,
                   const std::string& found,
                   bool ok) {
  met = met && ok;
  write(fmt::format("| {} | {} | {}{} |", what, wanted, found, ok ? "" : " **(not met)**"));
}

void Study::write_faults(const std::vector<Outcome>& outcomes) {
  std::vector<std::string> lines;
  for (const Outcome& outcome : outcomes) {
    if (!outcome.error.empty()) lines.push_back(outcome.name + ": " + outcome.error);
    if (!outcome.faults.empty()) lines.push_back(outcome.name + ": " + outcome.faults.front());
  }
  if (lines.empty()) return;
  write("");
  constexpr std::size_t kMost = 20;
  for (std::size_t i = 0; i < std::min(kMost, lines.size()); ++i) write("    " + lines[i]);
  if (lines.size() > kMost) write(fmt::format("    and {} more", lines.size() - kMost));
}

void Study::count_row(const std::string& name, const std::vector<Outcome>& outcomes) {
  std::map<std::string, int> counts = count_statuses(outcomes);
  int poses = 0;
  for (const auto& [status, count] : counts) poses += count;
  write(fmt::format("| {} | {} | {} | {} | {} |", name, poses, counts["converged"],
                    sum_false(outcomes), others(outcomes)));
}

void Agreement::add(const std::string& knee, const Outcome& here, const Outcome& there) {
  const Difference d = difference(here, there);
  if (d.greatest > worst_.greatest) where_ = ", " + knee;
  worst_.greatest = std::max(worst_.greatest, d.greatest);
  worst_.statuses += d.statuses;
  worst_.compared += d.compared;
  false_poses_ += there.false_poses;
  lost_ += there.error.empty() ? 0 : 1;
}

std::string Agreement::row(double tolerance) const {
  return fmt::format("| {:.2g}{} | {} of {} | {}{} |", worst_.greatest, where_, worst_.statuses,
                     worst_.compared, false_poses_, within(tolerance) ? "" : " **(not met)**");
}

}  // namespace condyle::strangers
