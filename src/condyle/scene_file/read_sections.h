#pragma once

/// The parts of a scene file, each read into the scene in the units used inside. Called in this
/// order by parse_scene: later parts refer to earlier ones by name.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "condyle/scene/scene.h"
#include "condyle/scene_file/section.h"

namespace condyle {

void read_units(const Section& root, Scene& scene);
void read_bodies(const Section& root, Scene& scene);
void read_joint(const Section& root, Scene& scene);
void read_surfaces(const Section& root, Scene& scene);
void read_contacts(const Section& root, Scene& scene);
void read_wraps(const Section& root, Scene& scene);
void read_ligaments(const Section& root, Scene& scene);
void read_conditions(const Section& root, Scene& scene);
void read_loads(const Section& root, Scene& scene);
void read_sweep(const Section& root, Scene& scene);
void read_laxity(const Section& root, Scene& scene);
void read_simulation(const Section& root, Scene& scene);
void read_calibration(const Section& root, Scene& scene);

// Shared by them:

/// The whole of a file. Throws InputError for what is none: `expected` "a scene (TOML)".
[[nodiscard]] std::string text_of(const std::filesystem::path& file, const std::string& expected);

/// An angle [rad]. Throws for one beyond a turn, whose unit is mistaken.
[[nodiscard]] double read_angle(const Section& section, const std::string& key, const Scene& scene);

/// A rotation vector [rad], likewise.
[[nodiscard]] Eigen::Vector3d read_rotation(const Section& section,
                                            const std::string& key,
                                            const Scene& scene);

/// The keys `law` and what belongs to it, of a contact whose surfaces and state are known; `root`
/// for messages about its surfaces.
void read_layers(const Section& root,
                 const Section& section,
                 const Scene& scene,
                 ContactDescription& contact);

/// The keys of a surface's kind: places, directions, radii.
void read_shape(const Section& section, const Scene& scene, SurfaceDescription& surface);

/// The keys `wraps`, `side`, `inside` and `thickness` of a ligament whose ends are known.
void read_path(const Section& section, const Scene& scene, LigamentDescription& ligament);

/// Throws for an end that lies too deep in a surface that its ligament wraps on, and where there is
/// no path at the start pose; its length [mm] there. Of a ligament on a surface that is yet to be
/// fitted to its bone the distance of the ends.
[[nodiscard]] double start_length_of(const Section& section,
                                     const Scene& scene,
                                     const LigamentDescription& ligament);

/// Throws for a surface that no ligament wraps on; tells those that are fitted to their bone which
/// ligaments lead the fit.
void check_wraps_used(const Section& root, Scene& scene);

/// The keys `mesh` and `mesh_units`, where given.
[[nodiscard]] std::optional<MeshFile> read_mesh_file(const Section& section, const Scene& scene);

/// Two tables { body, at } on two different bodies.
[[nodiscard]] std::array<Attachment, 2> read_ends(const Section& section, const Scene& scene);

/// A rotation: a rotation vector in the declared angle, or three directions that form a
/// right-handed frame. Columns of the result are the directions.
[[nodiscard]] Eigen::Matrix3d read_axes(const Section& section,
                                        const std::string& key,
                                        const Scene& scene);

/// The condition that holds the flexion, -1 for none; a scene has one at most that a test could set.
[[nodiscard]] int flexion_condition(const Scene& scene);

/// The [[calibrate.parameter]] tables of [calibrate].
[[nodiscard]] std::vector<CalibrationParameter> read_fitted_numbers(const Section& calibrate,
                                                                    const Scene& scene);

/// The key `name`: usable as a name in a result file, and not among `taken`.
[[nodiscard]] std::string read_name(const Section& section, const std::vector<std::string>& taken);

template <typename T>
[[nodiscard]] std::vector<std::string> names_of(const std::vector<T>& items) {
  std::vector<std::string> names;
  for (const T& item : items) names.push_back(item.name);
  return names;
}

/// mm, cm, m with their factors to mm.
[[nodiscard]] const Choices<double>& length_units();

}  // namespace condyle
