#pragma once

/// Scenes whose ligaments wrap on surfaces of either body.

#include <string>

namespace condyle::test {

inline const std::string kWrappedHead = R"([units]
length = "mm"
angle = "deg"
force = "N"

[[body]]
name = "femur"
fixed = true

[[body]]
name = "tibia"
start.translation = [0, 0, 0]
start.rotation = [0, 0, 0]
)";

/// A strand from (-40, 0, 0) to (40, y, 0) over a cylinder of 10 mm about z through (0, -12, 0), from
/// y = 5 down to -25, everything prescribed.
inline const std::string kSlidingStrand = kWrappedHead + R"(
[[wrap]]
name = "post"
body = "femur"
kind = "cylinder"
point = [0, -12, 7]
axis = [0, 0, 1]
radius = 10

[[ligament]]
name = "strand"
ends = [{ body = "femur", at = [-40, 0, 0] }, { body = "tibia", at = [40, 0, 0] }]
wraps = ["post"]
law = "toe-linear"
stiffness = 1500
slack_length = 70

[[condition]]
name = "x"
kind = "translation"
axis = "x"
value = 0
[[condition]]
name = "y"
kind = "translation"
axis = "y"
value = 0
[[condition]]
name = "z"
kind = "translation"
axis = "z"
value = 0
[[condition]]
name = "rx"
kind = "rotation"
axis = "x"
value = 0
[[condition]]
name = "ry"
kind = "rotation"
axis = "y"
value = 0
[[condition]]
name = "rz"
kind = "rotation"
axis = "z"
value = 0

[sweep]
vary = "y"
from = 5
to = -25
step = -2.5
)";

/// A body that hangs on six strands, two over a ball of the femur, two over an ellipsoid of the tibia,
/// one over both, one straight, and is pushed aside.
inline const std::string kHangingBody = kWrappedHead + R"(
[[wrap]]
name = "ball"
body = "femur"
kind = "sphere"
center = [22, -8, 0]
radius = 9

[[wrap]]
name = "egg"
body = "tibia"
kind = "ellipsoid"
center = [0, -62, 0]
axes = [0, 0, 20]
semi_axes = [24, 9, 14]

[[ligament]]
name = "ball1"
ends = [{ body = "femur", at = [30, 20, 5] }, { body = "tibia", at = [26, -60, 12] }]
wraps = ["ball"]
law = "toe-linear"
stiffness = 1200
reference_strain = 0.03

[[ligament]]
name = "ball2"
ends = [{ body = "femur", at = [30, 20, -5] }, { body = "tibia", at = [26, -60, -12] }]
wraps = ["ball"]
law = "toe-linear"
stiffness = 1200
reference_strain = 0.03

[[ligament]]
name = "egg1"
ends = [{ body = "femur", at = [-34, 10, 16] }, { body = "tibia", at = [-20, -76, 8] }]
wraps = ["egg"]
law = "toe-linear"
stiffness = 900
reference_strain = 0.04

[[ligament]]
name = "egg2"
ends = [{ body = "tibia", at = [-20, -76, -8] }, { body = "femur", at = [-34, 10, -16] }]
wraps = ["egg"]
law = "toe-linear"
stiffness = 900
reference_strain = 0.04

[[ligament]]
name = "both"
ends = [{ body = "femur", at = [34, 18, 0] }, { body = "tibia", at = [16, -78, 0] }]
wraps = ["ball", "egg"]
law = "toe-linear"
stiffness = 700
reference_strain = 0.02

[[ligament]]
name = "straight"
ends = [{ body = "femur", at = [0, 15, -20] }, { body = "tibia", at = [4, -60, -22] }]
law = "toe-linear"
stiffness = 500
reference_strain = 0.02

[[ligament]]
name = "stay"
ends = [{ body = "femur", at = [-5, 5, 30] }, { body = "tibia", at = [-15, -50, 25] }]
law = "toe-linear"
stiffness = 300
reference_strain = 0.02

[[load]]
name = "weight"
body = "tibia"
kind = "force"
vector = [0, -120, 0]
at = [0, -80, 0]

[[load]]
name = "push"
body = "tibia"
kind = "force"
vector = [40, 0, 10]
at = [0, -70, 0]

[sweep]
vary = "push.scale"
from = -2
to = 2
step = 0.25
)";

}  // namespace condyle::test
