#pragma once

/// One sweep of a knee with and without the parts that a scene may or may not use: the quadric knee
/// from 0 to 90 degrees in steps of 5, its poses the same in all (on patches: nearly). Without
/// ligaments the motions that they leave are prescribed; so that it can be told what the ligaments
/// alone cost, there is a scene with both.

#include <string>
#include <vector>

#include "condyle/equilibrium/equilibrium_solver.h"

namespace condyle::accuracy {

struct Parts {
  bool patches = true;  ///< else the exact surfaces that they were fitted to
  bool ligaments = true;
  bool joint = true;  ///< joint coordinates of each pose
  bool stability = true;
  bool search = true;       ///< for contacts; else they are held closed
  bool prescribed = false;  ///< three more motions than flexion: nothing is free
};

struct PartScene {
  std::string name;  ///< one word, for the command line
  std::string what;  ///< for a table
  Parts parts;
  std::string more = {};  ///< the scene that is the same but for what this one does without
};

/// All parts, each part left out, and none.
[[nodiscard]] const std::vector<PartScene>& part_scenes();

/// Of part_scenes, by its name. Throws where there is none.
[[nodiscard]] const PartScene& part_scene(const std::string& name);

class PartSweep {
 public:
  static constexpr int kPoses = 18;

  explicit PartSweep(const Parts& parts);
  /// With that model in place of its own, one that asks the same of the solver.
  PartSweep(const PartSweep& other, Model model);

  [[nodiscard]] const Model& model() const { return model_; }
  /// Of 0 to kPoses.
  void solve(int pose, PoseResult& result);
  /// Forth over all poses and back to the first; returns how many converged, of 2 kPoses.
  int there_and_back(PoseResult& result);

 private:
  Model model_;
  EquilibriumOptions options_;
  std::vector<std::vector<double>> values_;  ///< of the conditions, by pose
  EquilibriumSolver solver_;
  Drive drive_;
};

}  // namespace condyle::accuracy
