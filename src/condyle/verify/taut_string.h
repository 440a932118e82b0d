#pragma once

/// The length of a ligament that wraps at poses that no run tells, by geodesics of the verifier's own:
/// from how it lies at a pose that is told, to poses near it or, step by step, to another one.

#include <Eigen/LU>

#include <optional>
#include <vector>

#include "condyle/verify/course.h"

namespace condyle::verification {

class TautString {
 public:
  /// As the pose tells it; `scene` must outlive it.
  TautString(const Scene& scene, const PoseResult& told, std::size_t ligament);

  /// As it is laid where nothing is known of it: on the surfaces that it runs through, the deepest first, over
  /// the side on which it is nearest to leaving each. Nothing where none is found, or a side is given and
  /// anything but rings that are not in the way is wrapped on.
  [[nodiscard]] static std::optional<TautString> first(const Scene& scene,
                                                       const RigidTransform& X_BA,
                                                       std::size_t ligament);

  /// Over tori several taut strings exist at a place, through the hole and round the outside; which of them is
  /// the first is the program's choice. All that are found, each once.
  [[nodiscard]] static std::vector<TautString> about_rings(const Scene& scene,
                                                           const RigidTransform& X_BA,
                                                           std::size_t ligament);

  /// [mm], where it lies.
  [[nodiscard]] double length() const;

  /// [mm] at a pose near the last one, on the surfaces that are touched; nothing where it does not
  /// settle. It lies there then.
  [[nodiscard]] std::optional<double> pulled_to(const RigidTransform& X_BA);

  /// The same at any pose: it leaves surfaces and comes to others on the way. Nothing, too, where an end
  /// passes through a surface of the other body.
  [[nodiscard]] std::optional<double> led_to(const RigidTransform& X_BA);

 private:
  /// A geodesic, frame of its surface.
  struct Arc {
    std::size_t wrap;
    Eigen::Vector3d P, t;
    double length;
  };
  /// Either end of it, ground frame: n out of the solid, b = t x n.
  struct Ends {
    Eigen::Vector3d P, n_P, t_P, b_P, Q, n_Q, t_Q, b_Q;
  };
  /// What the string lies between at a pose.
  struct Place {
    std::vector<WrapAt> wraps;
    BeginAt first, last;
  };
  TautString(const Scene& scene, const RigidTransform& X_BA, std::size_t ligament)
      : scene_(scene), ligament_(ligament), X_BA_(X_BA) {}
  [[nodiscard]] Place place_at(const RigidTransform& X_BA) const;
  [[nodiscard]] bool ends_inside(const Place& at) const;
  [[nodiscard]] std::vector<RigidTransform> way_to(const RigidTransform& X_BA) const;
  [[nodiscard]] static Arc changed(const Place& at, const Arc& arc, const Eigen::Vector4d& by);
  [[nodiscard]] static Ends ends_of(const Place& at, const Arc& arc);
  [[nodiscard]] static std::vector<Ends> all_ends(const Place& at, const std::vector<Arc>& arcs);
  [[nodiscard]] static Eigen::VectorXd bends(const Place& at,
                                             const std::vector<Arc>& arcs,
                                             const std::vector<Ends>& ends);
  [[nodiscard]] bool is_passed_over(const WrapAt& wrap) const;
  /// The straight piece that passes a surface which is not touched.
  struct Piece {
    std::size_t after = 0;  ///< arcs before it
    Eigen::Vector3d from, to;
  };
  [[nodiscard]] Piece piece_at(const Place& at, std::size_t wrap) const;
  [[nodiscard]] bool touches(std::size_t wrap) const;
  /// Newton at a place; false where it does not settle.
  bool tighten(const Place& at);
  [[nodiscard]] static std::optional<TautString> laid(const Scene& scene,
                                                      const RigidTransform& X_BA,
                                                      std::size_t ligament,
                                                      std::optional<int> across_rings);
  bool lay_over(const Place& at, std::size_t wrap, std::optional<int> across_rings);
  /// Of the surfaces that are not touched the one that a straight piece runs into deepest; -1: none is in the way.
  [[nodiscard]] int deepest_in_the_way(const Place& at) const;
  /// Over `deepest`, and what then is in the way; false where that does not come clear.
  bool lay(const Place& at, int deepest, std::optional<int> across_rings);
  void set_rates(const Place& at, const std::vector<Ends>& ends);
  bool changes_touch(const Place& at);

  const Scene& scene_;
  std::size_t ligament_;
  RigidTransform X_BA_;
  std::vector<Arc> arcs_;
  std::optional<Eigen::PartialPivLU<Eigen::MatrixXd>> rates_;  ///< of bends, at some pose near
};

}  // namespace condyle::verification
