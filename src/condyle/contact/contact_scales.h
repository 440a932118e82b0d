#pragma once

/// Lengths that tell contacts apart, in units of the model's length L.

namespace condyle {

/// Most contacts plus conditions at once: with six the pose is a mechanism and the loads follow
/// [Dortmans 1986 stops at five].
inline constexpr int kMaxConstraints = 6;

inline constexpr double kSampleSpacing = 0.04;  ///< of contact samples (1.2 mm for a knee)
inline constexpr double kAnywhere = 1e3;        ///< how far an open contact is looked for
inline constexpr double kMerge = 0.01;  ///< minima of the gap nearer than this are one contact
inline constexpr double kAllowedOverlap = 5e-7 / 30;  ///< the largest of a converged pose

}  // namespace condyle
