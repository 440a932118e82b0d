#include "condyle/network/motion_poses.h"

#include <algorithm>
#include <utility>

#include "condyle/contact/contact.h"
#include "condyle/elements/strain.h"
#include "condyle/equilibrium/describe_pose.h"
#include "condyle/network/contact_scout.h"

namespace condyle {
namespace {

/// Points of one pair, as the frame has them.
void add_point(const ContactPair& pair,
               const ContactPlaces& places,
               double force,
               const RigidTransform& X,
               ContactResult& result) {
  const ContactLinearization at =
      linearize_contact(*pair.on_B, places.on_ground, *pair.on_A, places.on_body, X);
  const double edge = edge_distance(pair, places.on_ground, places.on_body);
  result.points.push_back(describe_point(at, force, edge));
}

class FrameTeller {
 public:
  FrameTeller(const Scene& scene, const Model& model, const KneeNetwork& knee)
      : scene_(scene), model_(model), knee_(knee) {}

  PoseResult tell(const MotionFrame& frame) const {
    PoseResult pose;
    pose.value = frame.state.t;
    pose.status = PoseStatus::kConverged;
    pose.X_BA = frame.state.bodies[0].X;
    if (model_.joint) pose.joint = joint_coordinates(*model_.joint, pose.X_BA);
    add_contacts(frame, pose);
    for (std::size_t i = 0; i < model_.elements.size(); ++i) {
      const double length = frame.lines[i].length;
      pose.ligaments.push_back(
          {length, strain(model_.elements[i].law, length), frame.lines[i].force});
    }
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
    pose.contacts.resize(model_.pairs.size());
    for (std::size_t i = 0; i < knee_.places.size(); ++i) {
      if (!frame.state.contacts[i].closed) continue;
      const int pair = knee_.places[i];
      ContactResult& contact = pose.contacts[pair];
      contact.closed = true;
      add_point(model_.pairs[pair], frame.state.contacts[i], frame.contact_force[i], pose.X_BA,
                contact);
      check_edge(pair, contact.points.back(), pose);
    }
    for (ContactResult& contact : pose.contacts)
      if (contact.closed) set_resultant(contact);
    for (std::size_t p = 0; p < pose.contacts.size(); ++p)
      if (!pose.contacts[p].closed) add_nearest(frame, static_cast<int>(p), pose);
  }

  void add_nearest(const MotionFrame& frame, int pair, PoseResult& pose) const {
    int nearest = -1;
    for (std::size_t i = 0; i < knee_.places.size(); ++i)
      if (knee_.places[i] == pair && frame.state.contacts[i].followed &&
          (nearest < 0 || frame.contact_gap[i] < frame.contact_gap[nearest]))
        nearest = static_cast<int>(i);
    if (nearest < 0) return;
    ContactResult& contact = pose.contacts[pair];
    add_point(model_.pairs[pair], frame.state.contacts[nearest], 0, pose.X_BA, contact);
    contact.resultant_ground = contact.points[0].point_ground;
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
};

}  // namespace

std::vector<PoseResult> motion_poses(const Scene& scene,
                                     const Model& model,
                                     const KneeNetwork& knee,
                                     const Motion& motion) {
  const FrameTeller teller(scene, model, knee);
  std::vector<PoseResult> poses;
  poses.reserve(motion.frames.size());
  for (const MotionFrame& frame : motion.frames) poses.push_back(teller.tell(frame));
  return poses;
}

}  // namespace condyle
