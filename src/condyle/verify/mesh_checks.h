#pragma once

/// Are the bones themselves inside each other? Vertices of each mesh against the winding numbers of
/// the other body's. A little is explained by the fit; bones that passed through each other are
/// not.

#include <string>
#include <vector>

#include "condyle/results/run_file.h"
#include "condyle/verify/ledger.h"
#include "condyle/verify/winding.h"

namespace condyle::verification {

class MeshCheck {
 public:
  /// Takes the bodies' meshes from the run; cartilage of its own from its file, where that is there
  /// unchanged. Says in `not_checked` what it could not have.
  MeshCheck(const Run& run, std::vector<std::string>& not_checked);

  void check(const PoseResult& pose, Ledger& ledger) const;

 private:
  struct Part {
    std::string name;
    bool moving = false;
    std::unique_ptr<TriangleMesh> mesh;
    std::unique_ptr<Winding> winding;
  };
  void add(std::string name, bool moving, TriangleMesh mesh);
  void check_pair(const Part& points,
                  const Part& solid,
                  const RigidTransform& X,
                  Ledger& ledger) const;

  std::vector<Part> parts_;
  double explained_ = 0;  ///< by the fits of both sides [mm]
};

}  // namespace condyle::verification
