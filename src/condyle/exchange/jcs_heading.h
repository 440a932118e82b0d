#pragma once

/// Headings of knee testing robots (simVitro, as Open Knee(s) and KneeHub publish them): which joint
/// coordinate or load a column holds, and in which sense. Motions and loads have opposite senses there
/// ("Knee JCS Posterior [mm]" beside "JCS Load Anterior Drawer [N]"): each is read from its own words,
/// which are of the tibia.

#include <cstddef>
#include <optional>
#include <string>

namespace condyle {

/// "Knee JCS Posterior [mm]": anterior drawer (joint_table.h), turned round.
struct JcsMotion {
  std::size_t coordinate = 0;
  double sign = 1;    ///< of the coordinate where the column grows
  std::string words;  ///< "posterior"
};
/// Empty for other headings. Units in brackets or parentheses: mm for shifts, deg for turns.
[[nodiscard]] std::optional<JcsMotion> motion_of_heading(const std::string& heading);

/// "JCS Load External Rotation Torque [Nm]".
struct JcsLoad {
  std::string name;     ///< "external", after which a positive load is called
  bool moment = false;  ///< [N m], else [N]
};
[[nodiscard]] std::optional<JcsLoad> load_of_heading(const std::string& heading);

/// The first column: what goes from row to row.
enum class JcsDriven { kForce, kMoment, kFlexion };  ///< [N], [N m], [deg]
[[nodiscard]] std::optional<JcsDriven> driven_of_heading(const std::string& heading);

}  // namespace condyle
