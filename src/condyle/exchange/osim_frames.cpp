#include "condyle/exchange/osim_frames.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "condyle/input_error.h"

namespace condyle {
namespace {

constexpr int kDeepest = 50;  // frames fixed to frames

std::string last_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

/// "/jointset/knee_r" and "../../bodyset/femur_r" give "/bodyset/femur_r"; nothing where the path
/// leads out of the model.
std::string absolute(const std::string& path, const std::string& owner) {
  std::vector<std::string> parts;
  std::istringstream stream(path.rfind('/', 0) == 0 ? path : owner + '/' + path);
  for (std::string part; std::getline(stream, part, '/');) {
    if (part.empty() || part == ".") continue;
    if (part != "..") {
      parts.push_back(part);
      continue;
    }
    if (parts.empty()) return "";
    parts.pop_back();
  }
  return fmt::format("/{}", fmt::join(parts, "/"));
}

}  // namespace

OsimFrames::OsimFrames(const OsimModel& model, std::string file)
    : model_(model), file_(std::move(file)) {
  for (const OsimFrame& frame : model.frames) {
    by_path_[frame.path].push_back(&frame);
    by_name_[frame.name].push_back(&frame);
  }
}

bool OsimFrames::is_body(const std::string& name) const {
  return name == "ground" ||
         std::find(model_.bodies.begin(), model_.bodies.end(), name) != model_.bodies.end();
}

OsimPlace OsimFrames::find(const std::string& path,
                           const std::string& owner,
                           const std::string& who) const {
  return find(path, owner, who, 0);
}

OsimPlace OsimFrames::at(const OsimFrame& frame, int depth) const {
  const OsimPlace parent =
      find(frame.parent, frame.path, "PhysicalOffsetFrame \"" + frame.name + "\"", depth + 1);
  return {parent.body, parent.X * frame.X_parent};
}

OsimPlace OsimFrames::find(const std::string& path,
                           const std::string& owner,
                           const std::string& who,
                           int depth) const {
  if (depth > kDeepest)
    throw InputError(fmt::format("{}: {}: the frame {} is fixed to itself", file_, who, path));
  const std::string place = absolute(path, owner), name = last_of(path);
  if (const auto here = by_path_.find(place); here != by_path_.end())
    return at(*here->second.front(), depth);
  const auto named = by_name_.find(name);
  const std::vector<const OsimFrame*> namesakes =
      named == by_name_.end() ? std::vector<const OsimFrame*>() : named->second;
  if (place == "/ground" || (is_body(last_of(place)) && place == "/bodyset/" + last_of(place)))
    return {last_of(place), {}};
  if (is_body(name) && namesakes.empty()) return {name, {}};
  if (!is_body(name) && namesakes.size() == 1) return at(*namesakes[0], depth);
  const std::string asked = path.empty()    ? "named"
                            : path == place ? path
                                            : fmt::format("{} (from {})", path, owner);
  throw InputError(fmt::format("{}: {}: there {} {}", file_, who,
                               namesakes.empty() ? "is no frame" : "are several frames", asked));
}

const OsimFrames::Welds& OsimFrames::welds() const {
  if (welds_) return *welds_;
  Welds welds;
  for (const OsimJoint& joint : model_.joints) {
    if (joint.type != "WeldJoint") continue;
    const OsimPlace parent = find(joint.parent, joint.path, "WeldJoint \"" + joint.name + "\"");
    const OsimPlace child = find(joint.child, joint.path, "WeldJoint \"" + joint.name + "\"");
    const RigidTransform X = parent.X * child.X.inverse();  // of the child's body in the parent's
    welds[parent.body].push_back({child.body, X});
    welds[child.body].push_back({parent.body, X.inverse()});
  }
  return welds_.emplace(std::move(welds));
}

std::map<std::string, RigidTransform> OsimFrames::welded_to(const std::string& root) const {
  std::map<std::string, RigidTransform> poses = {{root, {}}};
  std::vector<std::string> reached = {root};
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const auto from = welds().find(reached[next]);
    if (from == welds().end()) continue;
    const RigidTransform X = poses.at(reached[next]);
    for (const Weld& weld : from->second)
      if (poses.emplace(weld.other, X * weld.X_other).second) reached.push_back(weld.other);
  }
  return poses;
}

}  // namespace condyle
