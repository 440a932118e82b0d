#pragma once

/// The shader programs of the renderer, GLSL 3.30. What each computes is told in docs/pictures.md.

namespace condyle::shaders {

/// Meshes: model to view by `X_VM`, view to clip by `scale` and `shift` (a parallel projection).
extern const char* const kMeshVertex;
/// One triangle that covers the picture.
extern const char* const kPageVertex;

/// Normal and height above the target of the nearest surface.
extern const char* const kGeometryFragment;
/// Nothing but depth.
extern const char* const kDepthFragment;
/// How much of the light around is kept from the nearest surface [0, 1], noisy, and its height.
extern const char* const kOcclusionFragment;
/// The same averaged over the 4 x 4 pixels of the noise, within one surface.
extern const char* const kSmoothFragment;
/// Shaded colour; alpha is how far this surface shows through the bone in front of it.
extern const char* const kShadeFragment;

}  // namespace condyle::shaders
