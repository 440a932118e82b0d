#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "strangers/pose_time.h"
#include "strangers/stranger_parts.h"

namespace condyle::strangers {

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

}  // namespace condyle::strangers
