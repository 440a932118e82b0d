#pragma once

/// Draws shaded meshes: opaque solids and bones through which the solids behind them show.
///
/// Passes: normals and heights at half size; ambient occlusion from them; then, with several
/// samples per pixel, the solids, in front of them the nearest bone surface, mixed by how far each
/// solid shows through, and last the marks. The same items give the same bytes.

#include <memory>
#include <vector>

#include "condyle/math/rigid_transform.h"
#include "condyle/pictures/camera.h"
#include "condyle/pictures/image.h"
#include "condyle/pictures/shaded_mesh.h"

namespace condyle {

enum class Layer {
  kSolid,  ///< opaque
  kBone,   ///< solids show through it as far as their colours say
  kMark    ///< closed shapes that must always be seen: faintly through whatever is in front of them
};

struct Item {
  int mesh = -1;        ///< as returned by Renderer::add
  RigidTransform X_PM;  ///< mesh frame to the picture's frame
  Layer layer = Layer::kSolid;
  double gloss = 0.1;   ///< strength of the highlight
  bool closed = false;  ///< its back faces are never seen and need not be drawn
};

/// Where everything turns to paper.
struct Fade {
  Frame frame;       ///< beyond it there is nothing [pixel]; empty: the whole page
  double width = 0;  ///< of the band inside it over which things fade [pixel]
};

class Renderer {
 public:
  /// Throws PictureError when the machine cannot draw.
  Renderer(int width, int height);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// Keeps a mesh for any number of pictures.
  int add(const ShadedMesh& mesh);
  /// Puts another mesh in the place of a kept one.
  void replace(int id, const ShadedMesh& mesh);

  [[nodiscard]] Image render(const Camera& camera,
                             const std::vector<Item>& items,
                             const Fade& fade = {});

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace condyle
