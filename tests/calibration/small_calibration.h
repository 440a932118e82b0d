#pragma once

/// The small scene with loads, a held coordinate, a second ligament and [calibrate], and a table that it
/// names: text that tests change line by line.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "condyle/input_error.h"
#include "condyle/scene_file/read_scene.h"
#include "scene/small_scene.h"
#include "support/scratch_folder.h"

namespace condyle::test {

inline const std::string kCalibratedScene = kSmallScene + R"(
[[ligament]]
name = "pACL"
ends = [{ body = "femur", at = [5, 20, 0] }, { body = "tibia", at = [5, -10, 0] }]
law = "quadratic"
stiffness = 20
reference_strain = 0.05

[[ligament]]
name = "strap"
ends = [{ body = "femur", at = [-5, 20, 0] }, { body = "tibia", at = [-5, -10, 0] }]
law = "polynomial"
coefficients = [1, 0.1]

[[load]]
name = "drawer"
body = "tibia"
kind = "force"
vector = [1, 0, 0]

[[load]]
name = "twist"
body = "tibia"
kind = "moment"
vector = [0, 1, 0]

[[condition]]
name = "held drawer"
kind = "anterior_drawer"
value = 0

[calibrate]
measurements = "knee.csv"
moment = "N m"
relative = ["ap30"]
huber = 3
curve_sd = [0.5, 1]
frame_sd = { femur = [2, 2], tibia = [1, 0] }
flexion_sd = 1
level_sd = 0.02
starts = 4
seed = 7
samples = 50

[[calibrate.load]]
name = "anterior"
load = "drawer"

[[calibrate.load]]
name = "internal"
load = "twist"

[[calibrate.load]]
name = "robot"
condition = "held drawer"

[[calibrate.parameter]]
of = ["aACL", "pACL"]
what = "reference_strain"
prior_sd = 0.03
bounds = [-0.4, 0.2]

[[calibrate.parameter]]
of = "*"
what = "stiffness"
prior_sd = 0.3
bounds = [0.2, 5]
together = true

[[calibrate.parameter]]
of = ["aACL"]
what = "insertion.tibia"
prior_sd = 2
normal_sd = 0.25
)";

inline std::string calibrated_scene_with(const std::string& from, const std::string& to) {
  return with(kCalibratedScene, from, to);
}

inline const std::string kTable = R"(specimen,test,flexion,load,level,coordinate,value,sd,use
k1,ap30,30,anterior,88,anterior_drawer,4.9,0.5,fit
k1,ap30,30,anterior,88,internal_rotation,-2.1,1.0,fit
k1,ap30,30,anterior,-88,anterior_drawer,-2.2,0.5,fit
k1,ie30,30,internal,3,internal_rotation,12,1.0,test
k1,robot,0,robot,4,reaction,60,5,fit
k1,robot,0,robot,4,aACL.force,55,5,fit
k1,passive,45,none,0,distraction,9.0,1.0,fit
)";

/// The number of the line on which `text` stands in `in`, from 1.
inline long line_of(const std::string& in, const std::string& text) {
  return 1 + std::count(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(in.find(text)), '\n');
}

/// A scene, in the folder where its table stands.
inline Scene scene_beside(const std::filesystem::path& folder, const std::string& table) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "knee.csv", std::ios::binary) << table;
  return parse_scene(kCalibratedScene, folder / "knee.toml");
}

}  // namespace condyle::test
