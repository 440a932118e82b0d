#pragma once

/// The pressure between elastic layers in colours: at each point of an articular surface that of
/// the depth to which it is pressed into the surface that its contact pairs it with, by the law of
/// the scene (contact/layer_law.h). Not the lattice of the solver: its points lie as the drawn
/// vertices do.

#include <optional>
#include <vector>

#include "condyle/contact/layer_law.h"
#include "condyle/pictures/gap_map.h"

namespace condyle {

/// Greatest pressure of all poses that have a place [N/mm²]; 0 for a run without layers.
[[nodiscard]] double greatest_pressure(const Run& run);

class PressureMap {
 public:
  /// `run` must outlive the map.
  explicit PressureMap(const Run& run);

  /// The end of its colours [N/mm²]: one scale for all pictures of the run.
  [[nodiscard]] double top() const { return top_; }

  /// At the point p with the unit normal n of a surface of the scene, in the frame of its body, X_P
  /// poses of the bodies as they stand [N/mm²]. Nothing where no layer faces it.
  [[nodiscard]] std::optional<double> pressure(std::size_t surface,
                                               const Eigen::Vector3d& p,
                                               const Eigen::Vector3d& n,
                                               const std::vector<RigidTransform>& X_P) const;

  /// Puts the colours of the pressure on the vertices of a mesh of that surface, `beyond` where
  /// there is none. Returns the outline of the area of contact, in the frame of the body.
  ShadedMesh paint(ShadedMesh& mesh,
                   std::size_t surface,
                   const std::vector<RigidTransform>& X_P,
                   const Paint& beyond,
                   double line_radius) const;

 private:
  GapMap gaps_;
  std::vector<std::optional<LayerLaw>> laws_;  ///< of each contact
  double top_ = 1;
};

}  // namespace condyle
