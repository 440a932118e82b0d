#include "exchange/osim_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "input_error.h"

namespace condyle {
namespace {

constexpr int kDeepest = 50;  // frames fixed to frames

std::string last_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// "/jointset/knee_r/femur_r_offset" is owned by "knee_r".
std::string owner_of(const std::string& path) {
  const std::size_t end = path.rfind('/');
  return end == std::string::npos ? "" : last_of(path.substr(0, end));
}

}  // namespace

OsimFrames::OsimFrames(const OsimModel& model, std::string file)
    : model_(model), file_(std::move(file)) {}

OsimPlace OsimFrames::find(const std::string& path,
                           const std::string& owner,
                           const std::string& who) const {
  return find(path, owner, who, 0);
}

OsimPlace OsimFrames::find(const std::string& path,
                           const std::string& owner,
                           const std::string& who,
                           int depth) const {
  if (depth > kDeepest)
    throw InputError(fmt::format("{}: {}: the frame {} is fixed to itself", file_, who, path));
  const std::string name = last_of(path);
  const bool named_here = path == name;  // no path before it
  for (const OsimFrame& frame : model_.frames) {
    if (frame.name != name || frame.owner != (named_here ? owner : owner_of(path))) continue;
    const OsimPlace parent =
        find(frame.parent, frame.owner, "PhysicalOffsetFrame \"" + name + "\"", depth + 1);
    return {parent.body, parent.X * frame.X_parent};
  }
  if (name == "ground") return {name, {}};
  if (std::find(model_.bodies.begin(), model_.bodies.end(), name) != model_.bodies.end())
    return {name, {}};
  throw InputError(
      fmt::format("{}: {}: there is no frame {}", file_, who, path.empty() ? "named" : path));
}

std::map<std::string, RigidTransform> OsimFrames::welded_to(const std::string& root) const {
  std::map<std::string, RigidTransform> poses = {{root, {}}};
  for (bool grew = true; grew;) {
    grew = false;
    for (const OsimJoint& joint : model_.joints) {
      if (joint.type != "WeldJoint") continue;
      const OsimPlace parent = find(joint.parent, joint.name, "WeldJoint \"" + joint.name + "\"");
      const OsimPlace child = find(joint.child, joint.name, "WeldJoint \"" + joint.name + "\"");
      const RigidTransform X = parent.X * child.X.inverse();  // of the child's body in the parent's
      const bool has_parent = poses.count(parent.body) > 0, has_child = poses.count(child.body) > 0;
      if (has_parent == has_child) continue;
      if (has_parent)
        poses[child.body] = poses[parent.body] * X;
      else
        poses[parent.body] = poses[child.body] * X.inverse();
      grew = true;
    }
  }
  return poses;
}

}  // namespace condyle
