#pragma once

/// The frames of an OpenSim model: which body each is fixed to, and which bodies are welded
/// together.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "condyle/exchange/osim_model.h"

namespace condyle {

/// A place fixed to a body.
struct OsimPlace {
  std::string body;
  RigidTransform X;  ///< in the body's frame [mm]
};

class OsimFrames {
 public:
  OsimFrames(const OsimModel& model, std::string file);

  /// The frame that the socket of the component at `owner` names by `path`, as OpenSim looks for
  /// it:
  /// "/bodyset/femur_r" from the model, "femur_r_offset", ".." and "../../bodyset/femur_r" from the
  /// component; where nothing stands there, the only frame of that name. Throws InputError, saying
  /// that `who` asks for it, where there is none, or several.
  [[nodiscard]] OsimPlace find(const std::string& path,
                               const std::string& owner,
                               const std::string& who) const;

  /// The bodies welded to `root`, itself included, with their poses in its frame [mm].
  [[nodiscard]] std::map<std::string, RigidTransform> welded_to(const std::string& root) const;

 private:
  [[nodiscard]] OsimPlace find(const std::string& path,
                               const std::string& owner,
                               const std::string& who,
                               int depth) const;
  [[nodiscard]] OsimPlace at(const OsimFrame& frame, int depth) const;
  [[nodiscard]] bool is_body(const std::string& name) const;

  /// A WeldJoint, seen from one of its bodies.
  struct Weld {
    std::string other;
    RigidTransform X_other;  ///< in the frame of the one [mm]
  };
  using Welds = std::map<std::string, std::vector<Weld>>;
  [[nodiscard]] const Welds& welds() const;

  const OsimModel& model_;
  std::string file_;
  std::map<std::string, std::vector<const OsimFrame*>> by_path_, by_name_;
  mutable std::optional<Welds> welds_;  // of each body, once they are asked for
};

}  // namespace condyle
