#pragma once

/// A wrap that is fitted to the mesh of its body: what is asked for, and how it came out.

#include <Eigen/Core>

#include <vector>

namespace condyle {

/// The shortest string of one ligament about a bone, at one angle of the preset flexion.
struct BoneString {
  int ligament = -1;    ///< index into Scene::ligaments
  double flexion = 0;   ///< from the start pose [rad]
  double straight = 0;  ///< distance of its ends [mm]
  double depth = 0;     ///< of the straight line in the bone, at most [mm]
  double length = 0;    ///< outside the smoothed mesh [mm]
  double fitted = 0;    ///< over the fitted surface [mm]; 0 where there is no such path
};

struct BoneFit {
  std::vector<int> ligaments;  ///< whose strings say where the bone is needed
  bool done = false;           ///< what follows, and the shape, is known
  double region = 0;           ///< vertices count up to here from where a string touches [mm]
  int vertices = 0;
  double rms = 0, max = 0;                ///< of the vertices from the surface [mm]
  double length_rms = 0, length_max = 0;  ///< of fitted - length over the strings that touch [mm]
  /// A point outside the surface on the side where the strings touch, frame of the body [mm]: paths
  /// pass there that name no side.
  Eigen::Vector3d side = Eigen::Vector3d::Zero();
  std::vector<BoneString> strings;  ///< that touch the bone
};

}  // namespace condyle
