/// The same knee, reached another way or lying elsewhere.

#include <fmt/format.h>

#include <string>
#include <vector>

#include "condyle/math/rotation.h"
#include "strangers/stranger_parts.h"

namespace condyle::strangers {
namespace {

struct Move {
  std::string name;
  double metres;
  bool femur, tibia, turned;
};

std::vector<Move> all_moves() {
  std::vector<Move> moves;
  for (const double metres : {0.1, 1.0, 3.0}) {
    moves.push_back({"femur", metres, true, false, false});
    moves.push_back({"tibia", metres, false, true, false});
    moves.push_back({"both", metres, true, true, false});
    moves.push_back({"both, and turned", metres, true, true, true});
  }
  return moves;
}

/// The femur and the tibia go different ways.
Knee moved(const Study::Source& source, const Move& move) {
  Knee knee = read_knee(source.name, source.scene);
  const Eigen::Vector3d ways[] = {{0.6, -0.64, 0.48}, {-0.48, 0.6, 0.64}};
  const Eigen::Vector3d turns[] = {{0.9, -1.7, 0.4}, {-0.5, 0.3, 2.1}};
  for (int body = 0; body < 2; ++body) {
    if (!(body == knee.scene.joint->femur.body ? move.femur : move.tibia)) continue;
    RigidTransform X{Eigen::Matrix3d::Identity(), 1000 * move.metres * ways[body]};
    if (move.turned) X.R = exp_rotation(turns[body]);
    move_body(knee, body, X);
  }
  return knee;
}

}  // namespace

void study_steps(Study& study) {
  const std::vector<std::string> ways = {
      kSweep, "--from 0 --to 120 --step 1", "--from 120 --to 0 --step -5",
      "--from 60 --to 120 --step 5", "--from 60 --to 0 --step -5"};
  const char* names[] = {"", "steps of 1", "down", "up from the middle", "down from the middle"};
  std::vector<Job> jobs;
  const std::vector<Study::Source> knees = study.all();
  for (const Study::Source& knee : knees) jobs.push_back({knee.name, reader(knee), ways, {100}});
  const Outcomes outcomes = study.run(jobs);
  study.write(
      "\n## Steps and directions\n\nAt 100 N, against 0 to 120 degrees by 5: the greatest "
      "difference of a joint coordinate (deg, mm) at values where both converge, and how many "
      "values have another status.\n");
  study.write(
      "| way | wanted | greatest difference | other status | false |\n|---|---|---|---|---|");
  for (std::size_t way = 1; way < ways.size(); ++way) {
    Agreement agreement;
    for (std::size_t i = 0; i < outcomes.size(); ++i)
      if (outcomes[i].size() == ways.size())
        agreement.add(knees[i].name, outcomes[i][0], outcomes[i][way]);
    study.met = study.met && agreement.within(1e-6);
    study.write(fmt::format("| {} | 1e-6, 0, 0 {}", names[way], agreement.row(1e-6)));
  }
  study.write_faults(flat(outcomes));
}

void study_places(Study& study) {
  const std::vector<Move> moves = all_moves();
  std::vector<Study::Source> knees = study.shipped;
  knees.insert(knees.end(), study.specimens.begin(), study.specimens.end());
  if (!study.population.empty()) knees.push_back(study.population.front());
  std::vector<Job> jobs;
  for (const Study::Source& knee : knees) {
    jobs.push_back({knee.name, reader(knee), {kSweep}, {100}});
    for (const Move& move : moves)
      jobs.push_back({fmt::format("{}, {} by {} m", knee.name, move.name, move.metres),
                      [knee, move] { return moved(knee, move); },
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
    Agreement agreement;
    for (std::size_t i = 0; i < knees.size(); ++i) {
      const std::size_t base = i * (moves.size() + 1);
      agreement.add(knees[i].name, outcomes[base].front(), outcomes[base + 1 + m].front());
    }
    study.met = study.met && agreement.within(1e-8);
    study.write(fmt::format("| {} | {} m | 1e-8, 0, 0 {}", moves[m].name, moves[m].metres,
                            agreement.row(1e-8)));
  }
  study.write_faults(flat(outcomes));
}

}  // namespace condyle::strangers
