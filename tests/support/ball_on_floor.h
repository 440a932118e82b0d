#pragma once

/// A ball of radius 10 about A's origin over the floor z = 0, under a vertical load.

#include "condyle/equilibrium/model.h"
#include "condyle/surface/exact_surfaces.h"

namespace condyle::test {

inline Model ball_on_floor(const char* load_name, double load) {
  Model model;
  ContactPair pair;
  pair.name = "floor";
  pair.on_B = make_plane({0, 0, 0}, {0, 0, 1});
  pair.on_A = make_sphere({0, 0, 0}, 10, true);
  model.pairs = {pair};
  Load vertical;
  vertical.vector = {0, 0, load};
  model.loads = {vertical};
  model.load_names = {load_name};
  model.length = 10;
  return model;
}

}  // namespace condyle::test
