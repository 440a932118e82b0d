#pragma once

/// `condyle simulate`: the knee of a scene, released, struck or driven.

#include <functional>
#include <vector>

#include "condyle/equilibrium/pose_result.h"
#include "condyle/network/motion.h"
#include "condyle/network/motion_lattices.h"
#include "condyle/on_progress.h"
#include "condyle/scene/fitted_surface.h"
#include "condyle/scene/scene.h"

namespace condyle {

/// A motion as poses over time (PoseResult::value is the time in s) with what only a motion has.
struct Simulation {
  MassProperties mass;            ///< of the moving body
  std::vector<PoseResult> poses;  ///< one for each frame
  Motion motion;                  ///< frames as the network has them
  double seconds = 0;             ///< of computing
  std::vector<int> contact_of;    ///< index into Scene::contacts of each contact of the network
};

/// How a motion goes on where another run of it was stopped, with the same bits.
struct SimulationKeeping {
  // Of that run, taken over as they are:
  std::vector<LatticeRefinement> refinements;  ///< of layers, one after the other
  std::vector<MotionStretch> stretches;        ///< since the last of them
  // Told of each that is computed:
  std::function<void(const LatticeRefinement&)> on_refinement;
  std::function<void(const MotionStretch&)> on_stretch;
};

/// Mass of the moving body: its numbers, or its mesh and density. Throws InputError where the scene
/// says neither.
[[nodiscard]] MassProperties moving_mass(const Scene& scene);

/// Throws InputError for a scene without [simulate].
void check_simulated_scene(const Scene& scene);

/// Needs scene.simulation. Throws InputError for a body without mass, an open mesh, or a start that
/// is no equilibrium, or where what is to be taken over is of another motion. `on_frame` is told of each
/// frame.
[[nodiscard]] Simulation simulate(const Scene& scene,
                                  const std::vector<FittedSurface>& surfaces,
                                  const OnProgress& on_frame = {},
                                  const SimulationKeeping& keeping = {});

}  // namespace condyle
