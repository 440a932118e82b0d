#pragma once

/// Pictures of the poses of a run. Two doors: `draw_knee` for one picture, `KneePictures` for many,
/// which keeps the bones in OpenGL's memory.

#include <memory>

#include "condyle/pictures/image.h"
#include "condyle/pictures/scenery.h"

namespace condyle {

inline constexpr int kLeastPicture = 200, kGreatestPicture = 8000;  ///< each way [pixel]

struct PictureOptions {
  int width = 1200, height = 900;  ///< [pixel]
  bool words = true;  ///< title, labels, bars; false: the knee alone, in the same place
  SurfaceColors colors = SurfaceColors::kPlain;  ///< of the articular surfaces
  bool hertz = false;   ///< ellipses of the contact pressure, where the run holds estimates
  bool panel = false;   ///< without words, as large as the page lets it be
  bool frames = false;  ///< the joint's frames of femur and tibia as arrows (joint_axes.h)
};

/// Is a picture of that size possible?
[[nodiscard]] bool is_drawable(const PictureOptions& options);

class KneePictures {
 public:
  /// `run` must outlive the pictures. Throws InputError for a size out of range or a run with
  /// nothing to draw, PictureError when the machine cannot draw.
  KneePictures(const Run& run, const PictureOptions& options);
  ~KneePictures();
  KneePictures(KneePictures&&) noexcept;
  KneePictures& operator=(KneePictures&&) noexcept;

  /// `pose` indexes run.sweep.poses and must have a place (results/run_view.h). The camera of a
  /// view is the same for all poses of a run.
  [[nodiscard]] Image draw(View view, std::size_t pose);

  /// A picture and what it shows, for words around it (pictures/annotate.h). The scenery refers to
  /// the pictures that drew it.
  struct Drawn {
    Image image;
    Scenery shown;
  };
  [[nodiscard]] Drawn draw_shown(View view, std::size_t pose);

  /// The camera of a view.
  [[nodiscard]] const Camera& camera(View view) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

[[nodiscard]] Image draw_knee(const Run& run,
                              View view,
                              std::size_t pose,
                              const PictureOptions& options = {});

}  // namespace condyle
