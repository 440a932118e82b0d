#pragma once

/// What of a run is drawn, as shaded meshes: bones and articular surfaces once per run, ligaments,
/// contact points and force arrows once per pose. P is the picture's frame: the body frame of the
/// tibia, which stands still in every picture while the femur moves over it.

#include <optional>
#include <vector>

#include "condyle/pictures/color_map.h"
#include "condyle/pictures/renderer.h"
#include "condyle/results/run_file.h"

namespace condyle {

/// Pose of every body in P when the moving body has the pose X_BA in the ground frame.
[[nodiscard]] std::vector<RigidTransform> body_poses(const Scene& scene,
                                                     const RigidTransform& X_BA);

/// A mesh that is fixed to a body.
struct BodyShape {
  int body = -1;
  Layer layer = Layer::kSolid;
  double gloss = 0.1;
  bool closed = false;
  ShadedMesh mesh;   ///< body frame
  int surface = -1;  ///< of the scene, where it is an articular surface
};
/// Bones, articular surfaces and what ligaments wrap on where that is no bone, of all bodies, patches
/// with vertices about `spacing` [mm] apart.
/// Works on runs without meshes or patches: then there is less to see.
[[nodiscard]] std::vector<BodyShape> body_shapes(const Run& run, double spacing = 1.2);
inline constexpr Paint kCartilage = {{186, 207, 223}, 0.42};

/// Scales that hold for all pictures of a run, so that they can be compared.
struct PictureScales {
  bool strain_known =
      true;  ///< some ligament has a slack length; else ligaments are coloured by force
  bool some_unstrained = false;     ///< and some other one has none
  double ligament_top = 0.05;       ///< strain [-] or force [N] at the upper end of the colours
  double ligament_greatest = 0.05;  ///< of all strands; above the end it has the end's colour
  double force_top = 100;           ///< largest contact force [N]
  double arrow_mm_per_n = 0.3;      ///< length of arrows
  double sweep_low = 0, sweep_high = 1;  ///< range of the swept value, poses that have a place
  double tube_radius = 1.5;              ///< [mm]
  double size = 1;  ///< of dots, lines, arrows and crosses, as a fraction of that for a knee
};
[[nodiscard]] PictureScales picture_scales(const Run& run, double size = 1);

inline constexpr Rgb kSlackColor = {168, 168, 165};
/// Of a taut one whose law knows no strain, where others are coloured by theirs.
inline constexpr Rgb kUnstrainedColor = {20, 122, 116};

[[nodiscard]] Rgb ligament_color(const PictureScales& scales,
                                 const LigamentDescription& described,
                                 const LigamentResult& ligament);

/// A ligament's line in P, end to end: along its path where it wraps; else straight when taut; when
/// slack, bowed away from the joint until it is as long as its slack length (within reason).
[[nodiscard]] std::vector<Eigen::Vector3d> ligament_line(const Scene& scene,
                                                         const std::vector<RigidTransform>& X_P,
                                                         std::size_t ligament,
                                                         const PoseResult& pose);

[[nodiscard]] ShadedMesh ligament_tubes(const Run& run,
                                        const PoseResult& pose,
                                        const std::vector<RigidTransform>& X_P,
                                        const PictureScales& scales);
/// Straight thin lines from end to end, for a knee that is taken apart.
[[nodiscard]] ShadedMesh ligament_threads(const Run& run,
                                          const PoseResult& pose,
                                          const std::vector<RigidTransform>& X_P,
                                          const PictureScales& scales);
/// Only where they end on a body, for the views that show it alone.
[[nodiscard]] ShadedMesh insertions(const Run& run,
                                    const PoseResult& pose,
                                    int body,
                                    const std::vector<RigidTransform>& X_P,
                                    const PictureScales& scales);

/// Points of the closed contacts at a pose, in P.
struct ContactMark {
  Eigen::Vector3d point;                    ///< [mm]
  Eigen::Vector3d toward_femur;             ///< unit normal out of the tibia
  double force = 0;                         ///< on the femur along toward_femur [N]
  double beyond = 0;                        ///< the edge of what is known of its surfaces [mm]
  std::optional<HertzEstimate> hertz = {};  ///< its major axis in P
  double peak_pressure = 0;                 ///< of elastic layers [N/mm²]
};
[[nodiscard]] std::vector<ContactMark> contact_marks(const Scene& scene, const PoseResult& pose);

/// The points that the contacts leave on a body over the converged poses, coloured by the swept
/// value and joined where they follow each other (results/contact_path.h); in the frame of that
/// body.
[[nodiscard]] ShadedMesh contact_paths(const Run& run, int body, const PictureScales& scales);
/// The same of the reference model, where the run holds one: thin, in kReferenceColor.
[[nodiscard]] ShadedMesh reference_paths(const Run& run, int body, const PictureScales& scales);
inline constexpr Rgb kReferenceColor = {190, 58, 40};
/// Balls at the contact points.
[[nodiscard]] ShadedMesh contact_points(const std::vector<ContactMark>& marks, double radius);
/// Crosses in the plane of the page over the points that lie beyond an edge. R_VP as of the camera.
[[nodiscard]] ShadedMesh edge_crosses(const std::vector<ContactMark>& marks,
                                      const Eigen::Matrix3d& R_VP,
                                      const PictureScales& scales);
/// Between the ends of contacts that are lines.
[[nodiscard]] ShadedMesh contact_lines(const Scene& scene,
                                       const PoseResult& pose,
                                       const PictureScales& scales);
/// The ellipses of Hertz' estimate in the tangent plane, to scale; nothing for marks without one.
[[nodiscard]] ShadedMesh hertz_ellipses(const std::vector<ContactMark>& marks);
inline constexpr Rgb kHertzColor = {226, 120, 62};
/// Arrows of the forces on the femur.
[[nodiscard]] ShadedMesh force_arrows(const std::vector<ContactMark>& marks,
                                      const PictureScales& scales);

}  // namespace condyle
