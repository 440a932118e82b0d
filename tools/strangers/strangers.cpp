/// condyle_strangers: how the program fares on knees that it was not tuned to. Runs the program on
/// them, verifies every pose, and writes docs/strangers.md with each figure beside the one wanted.
///
///   condyle_strangers PROGRAM SOURCE -o PAGE.md [--quick] [--sweeps N] [--threads N]
///   [--parts known,steps,...]

#include <fmt/format.h>

#include <unistd.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>

#include "condyle/math/rotation.h"
#include "condyle/start_threads.h"
#include "strangers/pose_time.h"
#include "strangers/stranger_jobs.h"

namespace condyle::strangers {
namespace {

namespace fs = std::filesystem;
using Outcomes = std::vector<std::vector<Outcome>>;

constexpr const char* kSweep = "--from 0 --to 120 --step 5";

struct Study {
  fs::path program, source, scratch;
  int threads = 1;
  bool quick = false;
  std::size_t rough_sweeps = 2000;
  std::string page;
  bool met = true;             ///< every figure that was wanted
  double slowest_failing = 0;  ///< [s]
  std::string slowest;
  std::vector<std::string> absent;

  struct Source {
    std::string name;
    fs::path scene;
  };
  std::vector<Source> population, specimens, shipped;

  [[nodiscard]] Outcomes run(const std::vector<Job>& jobs) {
    Outcomes outcomes = run_jobs(jobs, program, scratch, threads);
    for (const std::vector<Outcome>& job : outcomes)
      for (const Outcome& outcome : job)
        for (const StrangerPose& pose : outcome.poses)
          if (pose.status != "converged" && pose.seconds > slowest_failing) {
            slowest_failing = pose.seconds;
            slowest = fmt::format("{}, {:.6g} deg, {}", outcome.name, pose.value, pose.status);
          }
    return outcomes;
  }
  void write(const std::string& line) { page += line + "\n"; }
  /// A row "| what | wanted | found |".
  void figure(const std::string& what,
              const std::string& wanted,
              const std::string& found,
              bool ok) {
    met = met && ok;
    write(fmt::format("| {} | {} | {}{} |", what, wanted, found, ok ? "" : " **(not met)**"));
  }
};

std::function<Knee()> reader(const Study::Source& source) {
  return [source] { return read_knee(source.name, source.scene); };
}

void find_knees(Study& study) {
  study.shipped = {{"phantom", study.source / "data/phantom/knee.toml"}};
  const fs::path specimens = study.source / "../shared/specimens",
                 population = specimens / "clouthier2019_ssm/population";
  const auto add = [&](std::vector<Study::Source>& list, const std::string& name,
                       const fs::path& file) {
    if (fs::exists(file))
      list.push_back({name, file});
    else
      study.absent.push_back(name);
  };
  add(study.specimens, "Lenhart 2015", specimens / "lenhart2015/knee.toml");
  add(study.specimens, "Clouthier 2019, mean", specimens / "clouthier2019_ssm/knee.toml");
  if (fs::exists(specimens / "oai_pymskt"))
    add(study.specimens, "OAI", study.source / "tests/data/oai_pymskt.toml");
  else
    study.absent.emplace_back("OAI");
  if (fs::exists(population))
    for (const auto& entry : fs::directory_iterator(population))
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

std::vector<Study::Source> all(const Study& study) {
  std::vector<Study::Source> knees = study.shipped;
  knees.insert(knees.end(), study.specimens.begin(), study.specimens.end());
  knees.insert(knees.end(), study.population.begin(), study.population.end());
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

void write_faults(Study& study, const std::vector<Outcome>& outcomes) {
  std::vector<std::string> lines;
  for (const Outcome& outcome : outcomes) {
    if (!outcome.error.empty()) lines.push_back(outcome.name + ": " + outcome.error);
    if (!outcome.faults.empty()) lines.push_back(outcome.name + ": " + outcome.faults.front());
  }
  if (lines.empty()) return;
  study.write("");
  constexpr std::size_t kMost = 20;
  for (std::size_t i = 0; i < std::min(kMost, lines.size()); ++i) study.write("    " + lines[i]);
  if (lines.size() > kMost) study.write(fmt::format("    and {} more", lines.size() - kMost));
}

void count_row(Study& study, const std::string& name, const std::vector<Outcome>& outcomes) {
  std::map<std::string, int> counts = count_statuses(outcomes);
  int poses = 0;
  for (const auto& [status, count] : counts) poses += count;
  study.write(fmt::format("| {} | {} | {} | {} | {} |", name, poses, counts["converged"],
                          sum_false(outcomes), others(outcomes)));
}

constexpr const char* kCountHead =
    "| knee | poses | converged | of those false | the others |\n|---|---|---|---|---|";

/// (a) Known knees at three loads.
void study_known(Study& study) {
  std::vector<Job> jobs;
  const std::vector<Study::Source> knees = all(study);
  for (const Study::Source& knee : knees)
    jobs.push_back({knee.name, reader(knee), {kSweep}, {50, 100, 300}});
  const Outcomes outcomes = study.run(jobs);
  study.write(
      "\n## Known knees\n\n50, 100 and 300 N, 0 to 120 degrees by 5; each knee with 75 poses.\n");
  study.write(kCountHead);
  for (std::size_t i = 0; i < knees.size(); ++i) count_row(study, knees[i].name, outcomes[i]);
  write_faults(study, flat(outcomes));
  std::vector<Outcome> population;
  for (std::size_t i = 0; i < knees.size(); ++i)
    if (i >= study.shipped.size() + study.specimens.size())
      population.insert(population.end(), outcomes[i].begin(), outcomes[i].end());
  study.write("\n| figure | wanted | found |\n|---|---|---|");
  const auto part = [&](const std::string& name, const std::vector<Outcome>& list, std::size_t n) {
    if (n == 0) return;
    const int converged = count_statuses(list)["converged"], wanted = static_cast<int>(75 * n);
    study.figure(name + ": poses that converge", fmt::format("{} of {}", wanted, wanted),
                 fmt::format("{}", converged), converged == wanted);
    study.figure(name + ": false poses", "0", fmt::format("{}", sum_false(list)),
                 sum_false(list) == 0);
  };
  part("population", population, study.population.size());
  part("all", flat(outcomes), knees.size());
}

/// (b) The same poses whichever way they are reached.
void study_steps(Study& study) {
  const std::vector<std::string> ways = {
      kSweep, "--from 0 --to 120 --step 1", "--from 120 --to 0 --step -5",
      "--from 60 --to 120 --step 5", "--from 60 --to 0 --step -5"};
  const char* names[] = {"", "steps of 1", "down", "up from the middle", "down from the middle"};
  std::vector<Job> jobs;
  const std::vector<Study::Source> knees = all(study);
  for (const Study::Source& knee : knees) jobs.push_back({knee.name, reader(knee), ways, {100}});
  const Outcomes outcomes = study.run(jobs);
  study.write(
      "\n## Steps and directions\n\nAt 100 N, against 0 to 120 degrees by 5: the greatest "
      "difference of a joint coordinate (deg, mm) at values where both converge, and how many "
      "values have another status.\n");
  study.write(
      "| way | wanted | greatest difference | other status | false |\n|---|---|---|---|---|");
  for (std::size_t way = 1; way < ways.size(); ++way) {
    Difference worst;
    std::string where;
    int false_poses = 0;
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      if (outcomes[i].size() != ways.size()) continue;
      const Difference d = difference(outcomes[i][0], outcomes[i][way]);
      if (d.greatest > worst.greatest) where = ", " + knees[i].name;
      worst.greatest = std::max(worst.greatest, d.greatest);
      worst.statuses += d.statuses;
      worst.compared += d.compared;
      false_poses += outcomes[i][way].false_poses;
    }
    const bool ok = worst.greatest <= 1e-6 && worst.statuses == 0 && false_poses == 0;
    study.met = study.met && ok;
    study.write(fmt::format("| {} | 1e-6, 0, 0 | {:.2g}{} | {} of {} | {}{} |", names[way],
                            worst.greatest, where, worst.statuses, worst.compared, false_poses,
                            ok ? "" : " **(not met)**"));
  }
  write_faults(study, flat(outcomes));
}

/// (c) The same knee wherever its scanner had its zero.
void study_places(Study& study) {
  struct Move {
    std::string name;
    double metres;
    bool femur, tibia, turned;
  };
  std::vector<Move> moves;
  for (const double metres : {0.1, 1.0, 3.0}) {
    moves.push_back({"femur", metres, true, false, false});
    moves.push_back({"tibia", metres, false, true, false});
    moves.push_back({"both", metres, true, true, false});
    moves.push_back({"both, and turned", metres, true, true, true});
  }
  const auto moved = [](const Study::Source& source, const Move& move) {
    return [source, move] {
      Knee knee = read_knee(source.name, source.scene);
      // The femur and the tibia go different ways.
      const Eigen::Vector3d ways[] = {{0.6, -0.64, 0.48}, {-0.48, 0.6, 0.64}};
      const Eigen::Vector3d turns[] = {{0.9, -1.7, 0.4}, {-0.5, 0.3, 2.1}};
      for (int body = 0; body < 2; ++body) {
        if (!(body == knee.scene.joint->femur.body ? move.femur : move.tibia)) continue;
        RigidTransform X{Eigen::Matrix3d::Identity(), 1000 * move.metres * ways[body]};
        if (move.turned) X.R = exp_rotation(turns[body]);
        move_body(knee, body, X);
      }
      return knee;
    };
  };
  std::vector<Study::Source> knees = study.shipped;
  knees.insert(knees.end(), study.specimens.begin(), study.specimens.end());
  if (!study.population.empty()) knees.push_back(study.population.front());
  std::vector<Job> jobs;
  for (const Study::Source& knee : knees) {
    jobs.push_back({knee.name, reader(knee), {kSweep}, {100}});
    for (const Move& move : moves)
      jobs.push_back({fmt::format("{}, {} by {} m", knee.name, move.name, move.metres),
                      moved(knee, move),
                      {kSweep},
                      {100}});
  }
  const Outcomes outcomes = study.run(jobs);
  study.write(
      "\n## Places\n\nMeshes, frames, insertions and loads of a body moved, and turned by 1 to 2 "
      "radians, at 100 N, against the knee where it was. Meshes are written in double "
      "precision.\n");
  study.write(
      "| moved | by | wanted | greatest difference | other status | false "
      "|\n|---|---|---|---|---|---|");
  for (std::size_t m = 0; m < moves.size(); ++m) {
    Difference worst;
    std::string where;
    int false_poses = 0, lost = 0;
    for (std::size_t i = 0; i < knees.size(); ++i) {
      const std::size_t base = i * (moves.size() + 1);
      const Outcome &here = outcomes[base].front(), &there = outcomes[base + 1 + m].front();
      const Difference d = difference(here, there);
      if (d.greatest > worst.greatest) where = ", " + knees[i].name;
      worst.greatest = std::max(worst.greatest, d.greatest);
      worst.statuses += d.statuses;
      worst.compared += d.compared;
      false_poses += there.false_poses;
      lost += there.error.empty() ? 0 : 1;
    }
    const bool ok = worst.greatest <= 1e-8 && worst.statuses == 0 && false_poses == 0 && lost == 0;
    study.met = study.met && ok;
    study.write(fmt::format("| {} | {} m | 1e-8, 0, 0 | {:.2g}{} | {} of {} | {}{} |",
                            moves[m].name, moves[m].metres, worst.greatest, where, worst.statuses,
                            worst.compared, false_poses, ok ? "" : " **(not met)**"));
  }
  write_faults(study, flat(outcomes));
}

/// (d) Rough bone.
void study_roughness(Study& study) {
  std::vector<Study::Source> knees = study.shipped;
  knees.insert(knees.end(), study.population.begin(), study.population.end());
  const std::vector<double> sizes = {0.05, 0.1, 0.2, 0.3}, loads = {50, 100, 300};
  const std::size_t sweeps = study.quick ? 24 : study.rough_sweeps;
  const std::size_t of_one_seed = knees.size() * sizes.size() * loads.size();
  const std::size_t seeds = std::max<std::size_t>(1, (sweeps + of_one_seed - 1) / of_one_seed);
  std::vector<Job> jobs;
  for (std::size_t seed = 1; seed <= seeds; ++seed)
    for (const double rms : sizes)
      for (const Study::Source& knee : knees)
        jobs.push_back({fmt::format("{}, {} mm, seed {}", knee.name, rms, seed),
                        [knee, rms, seed] {
                          Knee rough = read_knee(knee.name, knee.scene);
                          roughen(rough, rms, 1.5, seed);
                          return rough;
                        },
                        {kSweep},
                        loads});
  const Outcomes outcomes = study.run(jobs);
  study.write(
      fmt::format("\n## Rough bone\n\n{} sweeps: {} knees, each at 50, 100 and 300 N, 0 to 120 "
                  "degrees by 5, with a random "
                  "field along the normals (correlated over 1.5 mm, {} seeds).\n",
                  jobs.size() * loads.size(), knees.size(), seeds));
  std::string head = kCountHead;
  study.write("| roughness, rms" + head.substr(6));
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    std::vector<Outcome> list;
    for (std::size_t i = 0; i < jobs.size(); ++i)
      if ((i / knees.size()) % sizes.size() == r)
        list.insert(list.end(), outcomes[i].begin(), outcomes[i].end());
    count_row(study, fmt::format("{} mm", sizes[r]), list);
  }
  write_faults(study, flat(outcomes));
  study.write("\n| figure | wanted | found |\n|---|---|---|");
  const int false_poses = sum_false(flat(outcomes));
  study.figure("false poses", "0", fmt::format("{}", false_poses), false_poses == 0);
}

/// (e) Time, one sweep after the other.
void study_time(Study& study) {
  const int threads = study.threads;
  study.threads = 1;
  std::vector<Job> jobs(study.quick ? 2 : 7,
                        {"phantom", reader(study.shipped[0]), {kSweep}, {}, false});
  const Outcomes outcomes = study.run(jobs);
  study.threads = threads;
  double least = 1e9;
  for (const Outcome& outcome : flat(outcomes)) {
    double sum = 0;
    for (const StrangerPose& pose : outcome.poses) sum += pose.seconds;
    if (!outcome.poses.empty())
      least = std::min(least, sum / static_cast<double>(outcome.poses.size()));
  }
  study.write(
      "\n## Time\n\nA failing pose: the slowest of all sweeps above, several at a time on all "
      "cores.\n");
  study.write("| figure | wanted | found |\n|---|---|---|");
  study.figure("slowest failing pose", "50 ms",
               study.slowest.empty()
                   ? "none failed"
                   : fmt::format("{:.1f} ms ({})", 1e3 * study.slowest_failing, study.slowest),
               study.slowest_failing <= 0.05);
  study.write(
      fmt::format("\nA pose of the phantom's sweep from 0 to 120 degrees takes {:.0f} us in the "
                  "mean on the wall, stability and events "
                  "included and the first pose, which has none before it, among them.\n",
                  1e6 * least));
  study.write(
      "\nThe mean pose that took 125 to 245 us, measured in the same way: sweeps of the phantom "
      "from 0 to 90 degrees by 5 in "
      "one process, from the stored start pose, with strains drawn anew for each, 1900 poses a "
      "line, processor time.\n");
  study.write(
      "| deviation of the strains | then | median now | mean now | wanted | poses lost "
      "|\n|---|---|---|---|---|---|");
  static constexpr std::pair<double, const char*> kThen[] = {
      {0.01, "245 us"}, {0.02, "173 us"}, {0.03, "125 us"}};
  for (const auto& [sd, then] : kThen) {
    const PoseTime time = pose_time(study.shipped[0].scene, sd, study.quick ? 10 : 100);
    study.met = study.met && time.mean <= 80;
    study.write(fmt::format("| {} | {} | {:.0f} us | {:.0f} us{} | 80 us | {} of {} |", sd, then,
                            time.median, time.mean, time.mean <= 80 ? "" : " **(not met)**",
                            time.failed, time.poses));
  }
}

int run(int argc, char** argv) {
  CLI::App app{"Knees that condyle was not tuned to"};
  Study study;
  fs::path output;
  std::vector<std::string> parts;
  study.threads = thread_count(0);
  app.add_option("PROGRAM", study.program, "condyle")->required()->check(CLI::ExistingFile);
  app.add_option("SOURCE", study.source, "the project's folder")
      ->required()
      ->check(CLI::ExistingDirectory);
  app.add_option("-o,--output", output, "page to write (Markdown)")->required();
  app.add_flag("--quick", study.quick, "a small selection");
  app.add_option("--sweeps", study.rough_sweeps, "of rough bone, at least")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--threads", study.threads, "sweeps at a time")->capture_default_str();
  app.add_option("--parts", parts,
                 "of known, steps, places, roughness, time; all where none is named")
      ->delimiter(',')
      ->check(CLI::IsMember({"known", "steps", "places", "roughness", "time"}));
  CLI11_PARSE(app, argc, argv);
  study.scratch = fs::temp_directory_path() / fmt::format("condyle_strangers_{}", ::getpid());
  find_knees(study);
  study.write(
      "# Strangers\n\nMade by `tools/strangers.sh`: knees that the program was not tuned to, swept "
      "by `condyle "
      "sweep`, every converged pose checked by `condyle verify` (docs/verify.md).");
  if (study.quick) study.write("\nA quick selection (`--quick`), not the whole study.");
  if (study.rough_sweeps != Study{}.rough_sweeps)
    study.write(fmt::format("\nOf rough bone a selection (`--sweeps {}`); the whole has 2000.",
                            study.rough_sweeps));
  for (const std::string& name : study.absent) {
    study.write(fmt::format("\nNot here, and left out: {}.", name));
    fmt::print(stderr, "not here, and left out: {}\n", name);
  }
  const auto wanted = [&](const char* part) {
    return parts.empty() || std::find(parts.begin(), parts.end(), part) != parts.end();
  };
  if (wanted("known")) study_known(study);
  if (wanted("steps")) study_steps(study);
  if (wanted("places")) study_places(study);
  if (wanted("roughness")) study_roughness(study);
  if (wanted("time")) study_time(study);
  fs::remove_all(study.scratch);
  fmt::print("{}", study.page);
  std::ofstream(output) << study.page;
  return study.met ? 0 : 2;
}

}  // namespace
}  // namespace condyle::strangers

int main(int argc, char** argv) {
  try {
    return condyle::strangers::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "condyle_strangers: %s\n", error.what());
    return 1;
  }
}
