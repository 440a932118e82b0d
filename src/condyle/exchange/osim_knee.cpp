#include "condyle/exchange/osim_knee.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

#include "condyle/exchange/osim_strands.h"
#include "condyle/file_ending.h"
#include "condyle/input_error.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using Poses = std::map<std::string, RigidTransform>;

bool contains(const std::string& text, const char* word) {
  return lower_case(text).find(word) != std::string::npos;
}

std::optional<Side> side_of(const std::string& name) {
  const std::string word = lower_case(name);
  const auto ends = [&](const char* end) {
    return word.size() > 2 && word.compare(word.size() - 2, 2, end) == 0;
  };
  if (ends("_r") || contains(word, "right")) return Side::kRight;
  if (ends("_l") || contains(word, "left")) return Side::kLeft;
  return std::nullopt;
}

std::optional<Compartment> compartment_of(const std::string& name) {
  if (contains(name, "med")) return Compartment::kMedial;
  if (contains(name, "lat")) return Compartment::kLateral;
  return std::nullopt;
}

class KneeFinder {
 public:
  KneeFinder(const OsimModel& model, const std::string& file, const OsimOptions& options)
      : model_(model), file_(file), options_(options), frames_(model, file) {}

  [[nodiscard]] OsimKnee find() {
    if (model_.ligaments.empty())
      fail("holds no Blankevoort1991Ligament, expected an OpenSim-JAM model of a knee");
    for (const OsimLigament& ligament : model_.ligaments)
      spans_.push_back({place_of(frames_, ligament, ligament.points.front()).body,
                        place_of(frames_, ligament, ligament.points.back()).body});
    choose_joint();
    find_contacts();
    find_anatomy();
    find_bones();
    find_ligaments();
    note_rest();
    return std::move(knee_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file_ + ": " + message);
  }

  [[nodiscard]] OsimPlace parent_of(const OsimJoint& joint) const {
    return frames_.find(joint.parent, joint.path, joint.type + " \"" + joint.name + "\"");
  }
  [[nodiscard]] OsimPlace child_of(const OsimJoint& joint) const {
    return frames_.find(joint.child, joint.path, joint.type + " \"" + joint.name + "\"");
  }

  [[nodiscard]] int spanning_ligaments(const OsimJoint& joint) const {
    const Poses a = frames_.welded_to(parent_of(joint).body),
                b = frames_.welded_to(child_of(joint).body);
    return static_cast<int>(
        std::count_if(spans_.begin(), spans_.end(), [&](const std::array<std::string, 2>& ends) {
          return (a.count(ends[0]) && b.count(ends[1])) || (b.count(ends[0]) && a.count(ends[1]));
        }));
  }

  [[nodiscard]] std::vector<std::string> spanned_joints() const {
    std::vector<std::string> names;
    for (const OsimJoint& joint : model_.joints)
      if (joint.type != "WeldJoint" && spanning_ligaments(joint) > 0) names.push_back(joint.name);
    return names;
  }

  void choose_joint() {
    int most = 0;
    const OsimJoint* rival = nullptr;  // spanned by as many
    for (const OsimJoint& joint : model_.joints) {
      if (joint.type == "WeldJoint") continue;
      if (!options_.joint.empty() && joint.name != options_.joint) continue;
      const int count = spanning_ligaments(joint);
      if (count == most && count > 0) rival = &joint;
      if (count <= most) continue;
      most = count;
      joint_ = &joint;
      rival = nullptr;
    }
    if (rival) {
      fail(fmt::format("as many ligaments span {} as {}, expected --joint to name one of them",
                       joint_->name, rival->name));
    }
    if (joint_) {
      knee_.joint = joint_->name;
      return;
    }
    if (options_.joint.empty())
      fail("no joint is spanned by its ligaments, expected a knee joint between femur and tibia");
    fail(fmt::format("--joint {}: no ligament spans a joint of this name, expected one of {}",
                     options_.joint, fmt::join(spanned_joints(), ", ")));
  }

  [[nodiscard]] const OsimMesh& mesh_at(const std::string& path, const OsimContact& contact) const {
    const std::string name = path.substr(path.rfind('/') + 1);
    for (const OsimMesh& mesh : model_.contact_meshes)
      if (mesh.name == name) return mesh;
    fail(fmt::format("Smith2018ArticularContactForce \"{}\": there is no contact mesh {}",
                     contact.name, path));
  }

  [[nodiscard]] OsimPlace place_of_mesh(const OsimMesh& mesh, const char* type) const {
    const OsimPlace frame =
        frames_.find(mesh.frame, mesh.path, fmt::format("{} \"{}\"", type, mesh.name));
    return {frame.body, frame.X * mesh.X_frame};
  }
  [[nodiscard]] std::string body_of(const OsimMesh& mesh) const {
    return place_of_mesh(mesh, "Smith2018ContactMesh").body;
  }

  void find_contacts() {
    // The joint's parent is the femur unless names say that it is the other way round.
    std::string femur = parent_of(*joint_).body, tibia = child_of(*joint_).body;
    reversed_ = contains(femur, "tibia") || contains(tibia, "femur");
    if (reversed_) std::swap(femur, tibia);
    in_femur_ = frames_.welded_to(femur);
    in_tibia_ = frames_.welded_to(tibia);
    std::vector<std::string> off;
    for (const OsimContact& contact : model_.contacts) {
      const OsimMesh *a = &mesh_at(contact.target, contact),
                     *b = &mesh_at(contact.casting, contact);
      if (in_tibia_.count(body_of(*a))) std::swap(a, b);
      if (!in_femur_.count(body_of(*a)) || !in_tibia_.count(body_of(*b))) {
        knee_.notes.push_back("contact " + contact.name + ": not between femur and tibia");
        continue;
      }
      if (!contact.applies) {
        knee_.notes.push_back("contact " + contact.name + ": applies no force");
        off.push_back(contact.name);
        continue;
      }
      std::optional<Compartment> compartment = compartment_of(contact.name);
      if (!compartment) compartment = compartment_of(b->name);
      if (!compartment) compartment = compartment_of(a->name);
      knee_.contacts.push_back({compartment, {*a, {}}, {*b, {}}, contact.logarithmic});
    }
    check_contacts(off);
    knee_.femur.name = body_of(knee_.contacts[0].femur.mesh);
    knee_.tibia.name = body_of(knee_.contacts[0].tibia.mesh);
    in_femur_ = frames_.welded_to(knee_.femur.name);
    in_tibia_ = frames_.welded_to(knee_.tibia.name);
    for (OsimPair& pair : knee_.contacts) {
      pair.femur.X = in(in_femur_, place_of_mesh(pair.femur.mesh, "Smith2018ContactMesh"));
      pair.tibia.X = in(in_tibia_, place_of_mesh(pair.tibia.mesh, "Smith2018ContactMesh"));
    }
  }

  /// `off`: names of those between these bones that apply no force.
  void check_contacts(const std::vector<std::string>& off) {
    if (knee_.contacts.empty() && !off.empty())
      fail(
          fmt::format("no Smith2018ArticularContactForce between the bones of {} applies force "
                      "({} {} off), expected one that does",
                      knee_.joint, fmt::join(off, ", "), off.size() == 1 ? "is" : "are"));
    if (knee_.contacts.empty()) {
      fail(fmt::format(
          "no Smith2018ArticularContactForce between the bones of {}, expected contact meshes of "
          "femur and tibia",
          knee_.joint));
    }
    if (knee_.contacts.size() == 1) knee_.contacts[0].compartment.reset();
    const bool named = knee_.contacts.size() == 2 && knee_.contacts[0].compartment &&
                       knee_.contacts[1].compartment &&
                       knee_.contacts[0].compartment != knee_.contacts[1].compartment;
    if (knee_.contacts.size() > 1 && !named) {
      fail(
          fmt::format("{} contacts between femur and tibia, expected one, or two whose names say "
                      "medial and lateral",
                      knee_.contacts.size()));
    }
  }

  /// X of a frame in the body that carries the contact mesh.
  [[nodiscard]] static RigidTransform in(const Poses& bodies, const OsimPlace& place) {
    return bodies.at(place.body) * place.X;
  }

  void find_anatomy() {
    std::optional<Side> named = side_of(joint_->name);
    if (!named) named = side_of(knee_.femur.name);
    if (options_.side && named && *named != *options_.side)
      knee_.notes.push_back(
          fmt::format("warning: by the names of its joint and bones a {} knee, by --side the other",
                      *named == Side::kRight ? "right" : "left"));
    if (options_.side)
      knee_.side = *options_.side;
    else if (named)
      knee_.side = *named;
    else
      fail(
          fmt::format("joint {}: its name does not end in _r or _l, expected --side", knee_.joint));

    OsimPlace parent = parent_of(*joint_), child = child_of(*joint_);
    RigidTransform X = joint_pose();  // of the child's frame in the parent's
    if (reversed_) {
      std::swap(parent, child);
      X = X.inverse();
    }
    const RigidTransform X_femur = in(in_femur_, parent), X_tibia = in(in_tibia_, child);
    knee_.X_FT = X_femur * X * X_tibia.inverse();
    const Vector3d flexion = axis_along(2), axial = axis_along(1);
    set_frame(knee_.femur, X_femur, flexion, axial - axial.dot(flexion) * flexion);
    set_frame(knee_.tibia, X_tibia, flexion - flexion.dot(axial) * axial, axial);
  }

  [[nodiscard]] RigidTransform joint_pose() const {
    RigidTransform X;
    for (const OsimAxis& r : joint_->rotations) {
      if (!r.axis.isZero())
        X.R = X.R * Eigen::AngleAxisd(r.value, r.axis.normalized()).toRotationMatrix();
    }
    for (const OsimAxis& t : joint_->translations) X.p += t.value * t.axis;
    return X;
  }

  /// The joint's rotation axis nearest to y (proximal) or z (to the right), turned along it.
  [[nodiscard]] Vector3d axis_along(int k) const {
    Vector3d best = Vector3d::Unit(k);
    double most = 0.7;
    for (const OsimAxis& r : joint_->rotations) {
      if (r.axis.isZero()) continue;
      const Vector3d axis = r.axis.normalized();
      if (std::abs(axis[k]) <= most) continue;
      most = std::abs(axis[k]);
      best = axis[k] > 0 ? axis : Vector3d(-axis);
    }
    return best;
  }

  /// `right` and `up` at right angles, in the joint's frame.
  void set_frame(OsimBody& body,
                 const RigidTransform& X,
                 const Vector3d& right,
                 const Vector3d& up) {
    const Vector3d z = right.normalized(), y = up.normalized();
    body.origin = X.p;
    body.lateral = X.R * (knee_.side == Side::kRight ? z : Vector3d(-z));
    body.proximal = X.R * y;
    body.anterior = X.R * y.cross(z);
  }

  [[nodiscard]] bool is_contact_mesh(const OsimMesh& mesh) const {
    return std::any_of(model_.contact_meshes.begin(), model_.contact_meshes.end(),
                       [&](const OsimMesh& m) { return m.file == mesh.file; });
  }

  /// The mesh attached to the body, or to a frame on it, that says bone, else the first that is no
  /// contact mesh.
  void find_bones() {
    for (OsimBody* body : {&knee_.femur, &knee_.tibia}) {
      const auto choose = [&](const auto& suits) {
        for (const OsimMesh& mesh : model_.bone_meshes) {
          if (body->bone || !suits(mesh)) continue;
          const OsimPlace place = place_of_mesh(mesh, "Mesh");
          if (place.body == body->name) body->bone = OsimPlacedMesh{mesh, place.X};
        }
      };
      choose([](const OsimMesh& mesh) { return contains(mesh.name + mesh.file, "bone"); });
      choose([&](const OsimMesh& mesh) { return !is_contact_mesh(mesh); });
    }
  }

  void find_ligaments() {
    OsimStrands strands = find_strands(model_, frames_, {in_femur_, in_tibia_, knee_.X_FT});
    knee_.wraps = std::move(strands.wraps);
    knee_.ligaments = std::move(strands.strands);
    if (knee_.ligaments.empty())
      fail(fmt::format("no ligament leads straight across {}", knee_.joint));
    for (std::string& note : strands.notes) knee_.notes.push_back(std::move(note));
  }

  void note_rest() {
    if (joint_->type != "CustomJoint") {
      knee_.notes.push_back(fmt::format("coordinates of {} {}, taken as 0 in the start pose",
                                        joint_->type, joint_->name));
    }
    for (const auto* axes : {&joint_->rotations, &joint_->translations})
      for (const OsimAxis& axis : *axes)
        if (!axis.unread.empty())
          knee_.notes.push_back(fmt::format("a {} of {} {}, taken as 0 in the start pose",
                                            axis.unread, joint_->type, joint_->name));
    for (const auto& [type, count] : model_.other_forces)
      knee_.notes.push_back(fmt::format("{} {}", count, type));
    std::vector<std::string> others;
    for (const std::string& body : model_.bodies)
      if (!in_femur_.count(body) && !in_tibia_.count(body)) others.push_back(body);
    if (!others.empty())
      knee_.notes.push_back("other bodies: " + fmt::format("{}", fmt::join(others, ", ")));
  }

  const OsimModel& model_;
  const std::string& file_;
  const OsimOptions& options_;
  OsimFrames frames_;
  std::vector<std::array<std::string, 2>> spans_;  ///< bodies of the ends of each ligament
  const OsimJoint* joint_ = nullptr;
  bool reversed_ = false;
  Poses in_femur_, in_tibia_;  ///< bodies welded to either bone
  OsimKnee knee_;
};

}  // namespace

OsimKnee find_knee(const OsimModel& model, const std::string& file, const OsimOptions& options) {
  return KneeFinder(model, file, options).find();
}

}  // namespace condyle
