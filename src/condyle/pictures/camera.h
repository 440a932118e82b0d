#pragma once

/// The camera: a parallel projection, so that one scale bar holds for the whole picture, looking
/// along an anatomical direction. P is the picture's frame (the tibia's body frame), lengths in mm,
/// places in the picture in pixels from its upper left corner, x to the right and y down.

#include <Eigen/Core>

#include <string>

#include "condyle/scene/scene.h"

namespace condyle {

enum class View {
  kAnterior,
  kPosterior,
  kMedial,
  kLateral,
  kPlateau,   ///< tibia from above, without the femur
  kCondyles,  ///< femur from below, without the tibia
  kExploded   ///< femur lifted and tipped, so that both articular surfaces are seen
};
inline constexpr int kViewCount = 7;

/// "anterior", "posterior", ...
[[nodiscard]] const char* name(View view);
/// Throws InputError that lists the names.
[[nodiscard]] View view_from_name(const std::string& text);

/// Anatomical unit directions in P; lateral points away from the midline of the body on either
/// side.
struct Anatomy {
  Eigen::Vector3d lateral, anterior, proximal;
  bool known = true;  ///< else directions are named by axes
};
/// The tibia's anatomical directions; a scene without [joint] is taken as x anterior, y proximal, z
/// lateral, which nobody has said.
[[nodiscard]] Anatomy anatomy_of(const Scene& scene);

struct Camera {
  Eigen::Matrix3d R_VP = Eigen::Matrix3d::Identity();  ///< rows: right, up, towards the viewer
  Eigen::Vector3d target =
      Eigen::Vector3d::Zero();  ///< the point of P that is seen at `center` [mm]
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< [pixel]
  double mm_per_pixel = 0.1;

  /// x, y in pixels, z the height above the target towards the viewer in mm.
  [[nodiscard]] Eigen::Vector3d project(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d v = R_VP * (p - target);
    return {center.x() + v.x() / mm_per_pixel, center.y() - v.y() / mm_per_pixel, v.z()};
  }
};

/// Rows right, up, back of a view. Plateau and condyles are seen with anterior up, the exploded
/// knee from in front, above and its lateral side.
[[nodiscard]] Eigen::Matrix3d view_rotation(View view, const Anatomy& anatomy);

/// A rectangle of the picture [pixel].
struct Frame {
  double left = 0, top = 0, right = 0, bottom = 0;
};

/// The camera that shows all points inside the frame, as large as possible. `points` must not be
/// empty.
[[nodiscard]] Camera fit_camera(const Eigen::Matrix3d& R_VP,
                                const std::vector<Eigen::Vector3d>& points,
                                const Frame& frame);

/// Letter of the anatomical direction that a direction of P is closest to: A P M L S I.
[[nodiscard]] std::string direction_letter(const Anatomy& anatomy,
                                           const Eigen::Vector3d& direction);

}  // namespace condyle
