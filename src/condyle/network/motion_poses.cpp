#include "condyle/network/motion_poses.h"

#include <algorithm>
#include <utility>

#include "condyle/contact/contact.h"
#include "condyle/equilibrium/contact_rules.h"
#include "condyle/equilibrium/contact_shape.h"
#include "condyle/equilibrium/model_covers.h"
#include "condyle/equilibrium/pose_result.h"
#include "condyle/equilibrium/second_equilibrium.h"
#include "condyle/network/contact_detection.h"

namespace condyle {
namespace {

/// A point of a pair, as the frame has it.
ContactPointResult point_of(const ContactPair& pair,
                            const ContactPlaces& places,
                            double force,
                            const RigidTransform& X) {
  const ContactLinearization at = linearize_contact(pair, places, X);
  return describe_point(at, force, edge_distance(pair, places));
}

class FrameTeller {
 public:
  FrameTeller(const Scene& scene,
              const Model& model,
              const ContactCovers& covers,
              const KneeNetwork& knee)
      : scene_(scene), model_(model), knee_(knee), searches_(make_searches(model, covers)) {}

  PoseResult tell(const MotionFrame& frame) {
    PoseResult pose;
    pose.value = frame.state.t;
    pose.status = PoseStatus::kConverged;
    begin_pose({frame.state.bodies[0].X, model_.joint ? &*model_.joint : nullptr, model_.elements,
                frame.paths, model_.pairs.size()},
               pose);
    // What is viscous adds to the law.
    for (std::size_t i = 0; i < model_.elements.size(); ++i)
      pose.ligaments[i].force = frame.lines[i].force;
    add_contacts(frame, pose);
    add_layers(pose);
    for (std::size_t p = 0; p < pose.contacts.size(); ++p)
      if (!pose.contacts[p].closed && pose.contacts[p].points.empty()) add_open(p, pose);
    for (std::size_t i = 0; i < model_.conditions.size(); ++i) {
      const std::vector<int>& hold = scene_.simulation->hold;
      const auto held = std::find(hold.begin(), hold.end(), static_cast<int>(i));
      const double multiplier =
          held == hold.end()
              ? 0
              : frame.condition_multiplier[static_cast<std::size_t>(held - hold.begin())];
      pose.conditions.push_back(
          {evaluate(model_.conditions[i], 0, pose.X_BA).coordinate, multiplier});
    }
    to_file_frames(model_.origins, pose);
    return pose;
  }

 private:
  /// Closed points of each pair, or the nearest one.
  void add_contacts(const MotionFrame& frame, PoseResult& pose) const {
    for (std::size_t i = 0; i < knee_.places.size(); ++i) {
      if (!frame.state.contacts[i].closed) continue;
      const int pair = knee_.places[i];
      ContactResult& contact = pose.contacts[pair];
      add_closed_point(point_of(model_.pairs[pair], frame.state.contacts[i].places,
                                frame.contact_force[i], pose.X_BA),
                       contact);
      check_edge(pair, contact.points.back(), pose);
    }
    for (std::size_t p = 0; p < pose.contacts.size(); ++p)
      if (!pose.contacts[p].closed) add_nearest(frame, static_cast<int>(p), pose);
  }

  /// With the lattice and so the forces of the motion.
  void add_layers(PoseResult& pose) {
    for (std::size_t i = 0; i < knee_.potentials.size(); ++i) {
      ContactPotential& potential = *knee_.network.potentials[i].potential;
      const auto p = static_cast<std::size_t>(knee_.potentials[i]);
      ContactResult& contact = pose.contacts[p];
      potential.estimate_error(pose.X_BA);
      std::optional<Objection> objection = potential.describe(pose.X_BA, contact);
      if (!objection)
        objection = deeper_than_borne(model_.pairs[p], potential, searches_[p], pose.X_BA,
                                      model_.length, minima_);
      if (objection) {
        pose.status = objection->status;
        pose.reason = objection->reason;
      }
    }
  }

  /// A pair of which the motion follows no point: where its gap is smallest, as a sweep tells it.
  void add_open(std::size_t p, PoseResult& pose) {
    const ContactPair& pair = model_.pairs[p];
    if (look_at_open_pair(pair, searches_[p], pose.X_BA, model_.length, minima_) ==
        OpenPair::kApart)
      return;
    const GapMinimum& nearest = minima_.front();
    set_nearest_point(point_of(pair, nearest.places, 0, pose.X_BA), pose.contacts[p]);
    add_remark(pose, overlap_of_held_open(pair, nearest.gap));
  }

  /// The nearest of the open points that the motion follows.
  void add_nearest(const MotionFrame& frame, int pair, PoseResult& pose) const {
    int nearest = -1;
    for (std::size_t i = 0; i < knee_.places.size(); ++i)
      if (knee_.places[i] == pair && frame.state.contacts[i].followed &&
          (nearest < 0 || frame.contact_gap[i] < frame.contact_gap[nearest]))
        nearest = static_cast<int>(i);
    if (nearest < 0) return;
    set_nearest_point(
        point_of(model_.pairs[pair], frame.state.contacts[nearest].places, 0, pose.X_BA),
        pose.contacts[pair]);
  }

  void check_edge(int pair, const ContactPointResult& point, PoseResult& pose) const {
    std::string reason = beyond_edge(model_.pairs[pair], point.edge_distance);
    if (reason.empty()) return;
    pose.status = PoseStatus::kLeftPatch;
    pose.reason = std::move(reason);
  }

  const Scene& scene_;
  const Model& model_;
  const KneeNetwork& knee_;
  std::vector<ContactSearch> searches_;  ///< one for each of Model::pairs
  std::vector<GapMinimum> minima_;
};

}  // namespace

std::vector<PoseResult> motion_poses(const Scene& scene,
                                     const Model& model,
                                     const ContactCovers& covers,
                                     const KneeNetwork& knee,
                                     const Motion& motion) {
  FrameTeller teller(scene, model, covers, knee);
  std::vector<PoseResult> poses;
  poses.reserve(motion.frames.size());
  for (const MotionFrame& frame : motion.frames) poses.push_back(teller.tell(frame));
  return poses;
}

}  // namespace condyle
