#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "strangers/stranger_parts.h"

namespace condyle::strangers {

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
    study.count_row(fmt::format("{} mm", sizes[r]), list);
  }
  study.write_faults(flat(outcomes));
  study.write("\n| figure | wanted | found |\n|---|---|---|");
  const int false_poses = sum_false(flat(outcomes));
  study.figure("false poses", "0", fmt::format("{}", false_poses), false_poses == 0);
}

}  // namespace condyle::strangers
