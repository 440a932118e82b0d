#include "accuracy/parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "accuracy/clock.h"
#include "accuracy/run_process.h"
#include "accuracy/study.h"
#include "support/allocation_count.h"
#include "support/counted_model.h"
#include "support/instruction_count.h"
#include "support/part_scenes.h"

namespace condyle::accuracy {
namespace {

/// Of a warm pose, means over the sweep, but for the instructions.
struct Cost {
  double microseconds = 0;
  long instructions = -1;  ///< of one pose in the middle; -1 unknown
  double allocations = 0, surfaces = 0, elements = 0;
  double set_up_kB = 0, sweep_kB = 0;  ///< heap of model and solver; more of it while sweeping
  int refused = 0;                     ///< poses that do not converge
};

constexpr int kVisits = 2 * PartSweep::kPoses;

void count_questions(const PartSweep& scene, Cost& cost) {
  test::Asked asked;
  PartSweep counting(scene, test::counted(scene.model(), asked));
  PoseResult pose;
  counting.solve(0, pose);
  counting.there_and_back(pose);
  asked = {};
  counting.there_and_back(pose);
  cost.surfaces = static_cast<double>(asked.surfaces) / kVisits;
  cost.elements = static_cast<double>(asked.elements) / kVisits;
}

Cost cost_of(const Parts& parts) {
  Cost cost;
  PoseResult pose;
  const test::HeapUse before;
  PartSweep scene(parts);
  cost.set_up_kB = static_cast<double>(before.bytes()) / 1024;
  scene.solve(0, pose);
  scene.there_and_back(pose);

  const test::AllocationCount allocations;
  const test::HeapUse sweeping;
  cost.refused = kVisits - scene.there_and_back(pose);
  cost.allocations = static_cast<double>(allocations.since_start()) / kVisits;
  cost.sweep_kB = static_cast<double>(sweeping.peak()) / 1024;
  constexpr int kMiddle = PartSweep::kPoses / 2;
  for (int k = 1; k < kMiddle; ++k) scene.solve(k, pose);
  cost.instructions = test::count_instructions([&] { scene.solve(kMiddle, pose); }).value_or(-1);
  count_questions(scene, cost);
  cost.microseconds = least_microseconds(
                          100000, [&] { scene.there_and_back(pose); }, 1.5) /
                      kVisits;
  return cost;
}

std::optional<Cost> parse(const std::string& line) {
  std::istringstream stream(line);
  Cost c;
  if (stream >> c.microseconds >> c.instructions >> c.allocations >> c.surfaces >> c.elements >>
      c.set_up_kB >> c.sweep_kB >> c.refused)
    return c;
  return std::nullopt;
}

struct Row {
  PartScene scene;
  Cost cost;
  double megabytes;  ///< of its process
};

std::vector<Row> measure(Study& study) {
  std::vector<Row> rows;
  for (const PartScene& scene : part_scenes()) {
    const Process process =
        run_process({"/proc/self/exe", "-", "-", std::string(kPartPrefix) + scene.name});
    const std::optional<Cost> cost = parse(process.output);
    if (!process.good || !cost) throw std::runtime_error("cannot measure " + scene.name);
    study.require(cost->refused == 0, "all poses converge: " + scene.what);
    study.require(cost->allocations == 0, "a warm pose allocates nothing: " + scene.what);
    rows.push_back({scene, *cost, process.megabytes});
  }
  return rows;
}

/// What a scene does without it does not pay for.
void require_less(const std::vector<Row>& rows, Study& study) {
  for (const Row& row : rows) {
    const auto more = std::find_if(rows.begin(), rows.end(), [&](const Row& other) {
      return other.scene.name == row.scene.more;
    });
    if (more == rows.end()) continue;
    const Cost &less = row.cost, &all = more->cost;
    study.require(less.instructions < all.instructions || all.instructions < 0,
                  "fewer instructions: " + row.scene.what);
    study.require(less.surfaces <= all.surfaces && less.elements <= all.elements,
                  "no more is asked of surfaces and elements: " + row.scene.what);
  }
}

/// The command line's own cost: what a scene draws, and what it does not.
std::string commands(const Setting& setting, std::vector<double>& megabytes) {
  const std::string program = (setting.root / "build/condyle").string();
  const std::string scene = (setting.root / "data/phantom/knee.toml").string();
  const std::string run = (setting.folder / "parts.h5").string();
  const std::string folder = (setting.folder / "pictures").string();
  const std::vector<std::pair<std::string, std::vector<std::string>>> lines{
      {"`condyle --version`", {program, "--version"}},
      {"`condyle fit`: four patches from two meshes", {program, "fit", scene, "-o", run}},
      {"`condyle sweep`: and 19 poses, with stability and events",
       {program, "sweep", scene, "-o", run, "--from", "0", "--to", "90", "--step", "5"}},
      {"`condyle render` of it: one picture",
       {program, "render", run, "-o", folder, "--at", "30", "--view", "anterior"}},
      {"`condyle render`: all 19 poses",
       {program, "render", run, "-o", folder, "--view", "anterior", "--movie"}}};
  std::string page =
      "\n| the program on the phantom knee | processor time | peak memory |\n|---|---|---|\n";
  fmt::ostream csv = setting.table("commands");
  csv.print("command,ms,megabytes\n");
  for (const auto& [name, line] : lines) {
    Process best;
    for (int k = 0; k < 3; ++k) {
      const Process process = run_process(line);
      if (k == 0 || (process.good && process.seconds < best.seconds)) best = process;
    }
    if (!best.good) continue;
    megabytes.push_back(best.megabytes);
    csv.print("\"{}\",{:.1f},{:.1f}\n", name, best.seconds * 1e3, best.megabytes);
    page +=
        fmt::format("| {} | {:.0f} ms | {:.0f} MB |\n", name, best.seconds * 1e3, best.megabytes);
  }
  return page;
}

}  // namespace

int measure_part(const std::string& name) {
  const Cost c = cost_of(part_scene(name).parts);
  fmt::print("{} {} {} {} {} {} {} {}\n", c.microseconds, c.instructions, c.allocations, c.surfaces,
             c.elements, c.set_up_kB, c.sweep_kB, c.refused);
  return 0;
}

Study study_parts(const Setting& setting) {
  Study study;
  const std::vector<Row> rows = measure(study);
  require_less(rows, study);
  fmt::ostream csv = setting.table("parts");
  csv.print(
      "scene,microseconds,instructions,allocations,surfaces,elements,set_up_kB,sweep_kB,"
      "megabytes\n");
  study.page =
      "The quadric knee from 0 to 90° in steps of 5°, warm, two contacts and eight ligaments; each "
      "row in a process of its own. Instructions: of the pose at 45°, counted one by one. Asked: "
      "how "
      "often a surface is asked for a point, an element for its force. Heap: of model and solver, "
      "and what a sweep takes beside it.\n\n"
      "| scene | time per pose | instructions | surfaces asked | elements asked | allocations per "
      "pose | heap, set up [kB] | more while sweeping [kB] | process [MB] |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const auto& [scene, c, megabytes] : rows) {
    csv.print("\"{}\",{:.2f},{},{},{:.1f},{:.1f},{:.1f},{:.1f},{:.1f}\n", scene.what,
              c.microseconds, c.instructions, c.allocations, c.surfaces, c.elements, c.set_up_kB,
              c.sweep_kB, megabytes);
    study.page += fmt::format(
        "| {} | {:.1f} µs | {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} |\n",
        scene.what, c.microseconds, c.instructions < 0 ? "" : fmt::format("{}", c.instructions),
        c.surfaces, c.elements, c.allocations, c.set_up_kB, c.sweep_kB, megabytes);
  }
  std::vector<double> megabytes;
  study.page += commands(setting, megabytes);
  const auto all = static_cast<double>(rows.front().cost.instructions);
  std::vector<std::string> shares;
  for (const Row& row : rows)
    if (row.scene.more == "all")
      shares.push_back(fmt::format("{} {:.0f} %", row.scene.name,
                                   100 * (1 - static_cast<double>(row.cost.instructions) / all)));
  study.in_short.push_back(fmt::format(
      "**A scene pays for what it uses.** A warm pose allocates nothing, and what a scene leaves "
      "out "
      "it does not pay for; of the instructions of a pose with everything that is: {}. The tests "
      "count instructions, questions to surfaces and elements, and allocations.",
      fmt::join(shares, ", ")));
  if (megabytes.size() == 5)
    study.in_short.push_back(fmt::format(
        "**Memory:** the program starts with {:.0f} MB, sweeps the phantom in {:.0f} MB, and takes "
        "{:.0f} MB once it draws.",
        megabytes[0], megabytes[2], megabytes[3]));
  return study;
}

}  // namespace condyle::accuracy
