#include "strangers/stranger_jobs.h"

#include <fmt/format.h>
#include <sys/wait.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

namespace condyle::strangers {
namespace {

using Json = nlohmann::json;

std::string contents(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The JSON of a command; its error where there is none.
Json run_json(const std::string& command, const std::filesystem::path& folder, std::string& error) {
  const std::filesystem::path out = folder / "out.json", err = folder / "err.txt";
  const int status = std::system(
      fmt::format("{} --json > '{}' 2> '{}' < /dev/null", command, out.string(), err.string())
          .c_str());
  Json json = Json::parse(contents(out), nullptr, false);
  if (WIFSIGNALED(status) || WEXITSTATUS(status) > 2)
    error = fmt::format("ended by signal or status {}", status);
  else if (json.is_discarded())
    error = contents(err).substr(0, 200);
  else if (json.contains("error"))
    error = json["error"].get<std::string>();
  return json;
}

double number(const Json& json) { return json.is_number() ? json.get<double>() : std::nan(""); }

void read_poses(const Json& json, Outcome& outcome) {
  for (const Json& row : json["poses"]) {
    StrangerPose pose{
        number(row["value"]), row["status"].get<std::string>(), number(row["seconds"]), {}};
    if (row.contains("joint") && pose.status == "converged")
      for (const Json& q : row["joint"]) pose.joint.push_back(number(q));
    outcome.poses.push_back(std::move(pose));
  }
}

Outcome run_sweep(const std::string& name,
                  const std::filesystem::path& program,
                  const std::filesystem::path& scene,
                  const std::string& options,
                  bool verify) {
  Outcome outcome{.name = name};
  const std::filesystem::path folder = scene.parent_path(), run = folder / "run.h5";
  const Json swept = run_json(fmt::format("'{}' sweep '{}' -o '{}' {}", program.string(),
                                          scene.string(), run.string(), options),
                              folder, outcome.error);
  if (!outcome.error.empty()) return outcome;
  read_poses(swept, outcome);
  if (!verify) return outcome;
  const Json verified = run_json(fmt::format("'{}' verify '{}'", program.string(), run.string()),
                                 folder, outcome.error);
  if (!outcome.error.empty()) return outcome;
  outcome.false_poses = verified["counts"]["false"].get<int>();
  for (const Json& fault : verified["false_poses"])
    outcome.faults.push_back(fault["text"].get<std::string>());
  for (const Json& check : verified["checks"])
    if (check["check"] == "overlap of the surfaces")
      outcome.worst_gap = std::max(0.0, number(check["worst"]));
  return outcome;
}

std::vector<Outcome> run_job(const Job& job,
                             const std::filesystem::path& program,
                             const std::filesystem::path& folder) {
  std::vector<Outcome> outcomes;
  try {
    Knee knee = job.knee();
    const std::vector<double> as_it_is = {0};
    for (const double load : job.loads.empty() ? as_it_is : job.loads) {
      if (load > 0) load_with(knee, load);
      const std::filesystem::path scene = write_knee(knee, folder);
      for (const std::string& sweep : job.sweeps)
        outcomes.push_back(
            run_sweep(load > 0 ? fmt::format("{}, {:.0f} N", job.name, load) : job.name, program,
                      scene, sweep, job.verify));
    }
  } catch (const std::exception& error) {
    outcomes.push_back({.name = job.name, .error = error.what()});
  }
  std::filesystem::remove_all(folder);
  return outcomes;
}

}  // namespace

std::vector<std::vector<Outcome>> run_jobs(const std::vector<Job>& jobs,
                                           const std::filesystem::path& program,
                                           const std::filesystem::path& scratch,
                                           int threads) {
  std::vector<std::vector<Outcome>> outcomes(jobs.size());
  std::atomic<std::size_t> next = 0, done = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < jobs.size(); i = next++) {
      outcomes[i] = run_job(jobs[i], program, scratch / std::to_string(i));
      fmt::print(stderr, "{:>5} of {}: {}{}\n", ++done, jobs.size(), jobs[i].name,
                 outcomes[i].empty() || outcomes[i].back().error.empty()
                     ? ""
                     : ": " + outcomes[i].back().error);
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  return outcomes;
}

std::map<std::string, int> count_statuses(const std::vector<Outcome>& outcomes) {
  std::map<std::string, int> counts;
  for (const Outcome& outcome : outcomes)
    for (const StrangerPose& pose : outcome.poses) ++counts[pose.status];
  return counts;
}

Difference difference(const Outcome& a, const Outcome& b) {
  Difference result;
  for (const StrangerPose& one : a.poses)
    for (const StrangerPose& other : b.poses) {
      if (std::abs(one.value - other.value) > 1e-9) continue;
      ++result.compared;
      if (one.status != other.status) ++result.statuses;
      if (one.joint.empty() || other.joint.empty()) continue;
      for (std::size_t k = 0; k < one.joint.size(); ++k) {
        const double off = std::abs(one.joint[k] - other.joint[k]);
        result.greatest = std::max(result.greatest, k < 3 ? std::min(off, 360 - off) : off);
      }
    }
  return result;
}

}  // namespace condyle::strangers
