#pragma once

/// A small scene file with one of everything, as text that tests change line by line.

#include <stdexcept>
#include <string>

namespace condyle {

inline const std::string kSmallScene = R"(title = "ball and socket"
[units]
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

[joint]
side = "right"
femur = { body = "femur", origin = [0, 0, 0], lateral = [0, 0, 1], anterior = [1, 0, 0], proximal = [0, 1, 0] }
tibia = { body = "tibia", origin = [0, 0, 0], lateral = [0, 0, 1], anterior = [1, 0, 0], proximal = [0, 1, 0] }

[[surface]]
name = "ball"
body = "femur"
kind = "sphere"
center = [0, 20, 0]
radius = 20

[[surface]]
name = "plateau"
body = "tibia"
kind = "plane"
point = [0, 0, 0]
normal = [0, 1, 0]

[[contact]]
name = "medial"
surfaces = ["ball", "plateau"]

[[ligament]]
name = "aACL"
ends = [{ body = "femur", at = [0, 20, 0] }, { body = "tibia", at = [0, -10, 0] }]
law = "toe-linear"
stiffness = 1500
slack_length = 30

[[condition]]
name = "bend"
kind = "flexion"
value = 0

[[load]]
name = "weight"
body = "tibia"
kind = "force"
vector = [0, 100, 0]

[sweep]
vary = "bend"
from = 0
to = 120
step = 5
)";

/// `text` with the first occurrence of `from` replaced.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the scene does not hold: " + from);
  return text.replace(at, from.size(), to);
}

inline std::string small_scene_with(const std::string& from, const std::string& to) {
  return with(kSmallScene, from, to);
}

}  // namespace condyle
