#include <fmt/format.h>

#include <string>
#include <vector>

#include "strangers/stranger_parts.h"

namespace condyle::strangers {

void study_known(Study& study) {
  std::vector<Job> jobs;
  const std::vector<Study::Source> knees = study.all();
  for (const Study::Source& knee : knees)
    jobs.push_back({knee.name, reader(knee), {kSweep}, {50, 100, 300}});
  const Outcomes outcomes = study.run(jobs);
  study.write(
      "\n## Known knees\n\n50, 100 and 300 N, 0 to 120 degrees by 5; each knee with 75 poses.\n");
  study.write(kCountHead);
  for (std::size_t i = 0; i < knees.size(); ++i) study.count_row(knees[i].name, outcomes[i]);
  study.write_faults(flat(outcomes));
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

}  // namespace condyle::strangers
