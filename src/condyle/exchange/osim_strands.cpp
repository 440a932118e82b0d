#include "condyle/exchange/osim_strands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace condyle {
namespace {

using Eigen::Vector3d;
using Poses = std::map<std::string, RigidTransform>;

/// Points of a path in the frames of the two bones, in order from the femur to the tibia.
struct Crossing {
  std::vector<Vector3d> femur, tibia;
};

double length(const std::vector<Vector3d>& points) {
  double sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).norm();
  return sum;
}

class StrandFinder {
 public:
  StrandFinder(const OsimModel& model, const OsimFrames& frames, const OsimBones& bones)
      : model_(model),
        frames_(frames),
        in_femur_(bones.in_femur),
        in_tibia_(bones.in_tibia),
        X_FT_(bones.X_FT) {}

  void add(const OsimLigament& ligament) {
    Crossing path;
    if (!find_crossing(ligament, path)) {
      left_out_.push_back(ligament.name);
      return;
    }
    const double taut = ligament.slack_length - length(path.femur) - length(path.tibia);
    if (!(taut > 0)) {
      never_free_.push_back(ligament.name);
      return;
    }
    if (taut < ligament.slack_length) shortened_.push_back(ligament.name);
    const double part = taut / ligament.slack_length;
    out_.strands.push_back({ligament.name, path.femur.back(), path.tibia.front(),
                            ligament.stiffness * part, ligament.transition_strain / part, taut,
                            find_wraps(ligament, path)});
  }

  [[nodiscard]] OsimStrands result() {
    note("with a wrap object that is on another bone, not active or of another kind, taken without",
         straightened_);
    note("with points along a bone, replaced by their free part", shortened_);
    note("to other bones, over both bones twice, or without force", left_out_);
    note("with a slack length that is 0, or no longer than what lies along the bones", never_free_);
    out_.notes.emplace_back("damping of the ligaments");
    return std::move(out_);
  }

 private:
  /// The wraps of a ligament in the order in which it passes them, those on the femur first.
  std::vector<std::size_t> find_wraps(const OsimLigament& ligament, const Crossing& path) {
    std::vector<std::size_t> wraps;
    bool all = true;
    for (const std::string& name : ligament.wraps) {
      const std::optional<std::size_t> index = placed(name, ligament.name);
      if (index && std::find(wraps.begin(), wraps.end(), *index) == wraps.end())
        wraps.push_back(*index);
      all &= index.has_value();
    }
    if (!all) straightened_.push_back(ligament.name);
    const Vector3d from = path.femur.back(), way = X_FT_ * path.tibia.front() - from;
    std::stable_sort(wraps.begin(), wraps.end(), [&](std::size_t i, std::size_t k) {
      const OsimPlacedWrap &one = out_.wraps[i], &other = out_.wraps[k];
      if (one.on_femur != other.on_femur) return one.on_femur;
      return passed_at(one, from, way) < passed_at(other, from, way);
    });
    return wraps;
  }

  /// Where a straight strand passes the middle of a wrap, or the axis of a cylinder [of its length].
  [[nodiscard]] double passed_at(const OsimPlacedWrap& placed,
                                 const Vector3d& from,
                                 const Vector3d& way) const {
    const RigidTransform X = placed.on_femur ? placed.X : X_FT_ * placed.X;
    Vector3d along = way;
    if (placed.wrap.type == "WrapCylinder") along -= along.dot(X.R.col(2)) * X.R.col(2);
    const double square = along.dot(way);
    return square > 1e-6 * way.squaredNorm() ? along.dot(X.p - from) / square : 0;
  }

  /// The wrap object of that name among those of the scene; nothing where it cannot be one.
  std::optional<std::size_t> placed(const std::string& name, const std::string& ligament) {
    for (std::size_t i = 0; i < out_.wraps.size(); ++i)
      if (out_.wraps[i].wrap.name == name) return i;
    const auto found = std::find_if(model_.wraps.begin(), model_.wraps.end(),
                                    [&](const OsimWrap& wrap) { return wrap.name == name; });
    if (found == model_.wraps.end() || !found->active || !known(*found)) return std::nullopt;
    const OsimPlace place =
        frames_.find(found->frame, "", "wrap object \"" + name + "\" of \"" + ligament + "\"");
    const bool on_femur = in_femur_.count(place.body) > 0;
    if (!on_femur && in_tibia_.count(place.body) == 0) return std::nullopt;
    const RigidTransform X =
        (on_femur ? in_femur_ : in_tibia_).at(place.body) * place.X * found->X_frame;
    out_.wraps.push_back({*found, on_femur, X, side_of(*found, X)});
    return out_.wraps.size() - 1;
  }

  static bool known(const OsimWrap& wrap) {
    if (wrap.type == "WrapEllipsoid") return wrap.sizes.minCoeff() > 0;
    if (wrap.type == "WrapTorus") return wrap.sizes.x() > 0 && wrap.sizes.x() < wrap.sizes.y();
    return (wrap.type == "WrapSphere" || wrap.type == "WrapCylinder") && wrap.sizes.x() > 0;
  }

  /// "x", "+x", "-y": a point twice as far out as the surface goes.
  static std::optional<Vector3d> side_of(const OsimWrap& wrap, const RigidTransform& X) {
    std::string axis = wrap.quadrant;
    const double sign = axis.rfind('-', 0) == 0 ? -1 : 1;
    if (!axis.empty() && (axis[0] == '-' || axis[0] == '+')) axis.erase(0, 1);
    if (axis != "x" && axis != "y" && axis != "z") return std::nullopt;
    const Vector3d out = sign * 2 * wrap.sizes.cwiseAbs().sum() * Vector3d::Unit(axis[0] - 'x');
    return X * out;
  }

  /// False where the path does not go from one bone to the other, once.
  bool find_crossing(const OsimLigament& ligament, Crossing& path) const {
    if (!ligament.applies) return false;
    bool starts_on_femur = true, last_on_femur = true;
    int changes = 0;
    for (const OsimPathPoint& point : ligament.points) {
      const OsimPlace place = place_of(frames_, ligament, point);
      const bool on_femur = in_femur_.count(place.body) > 0;
      if (point.type != "PathPoint" || !(on_femur || in_tibia_.count(place.body))) return false;
      if (&point == &ligament.points.front())
        starts_on_femur = on_femur;
      else if (on_femur != last_on_femur)
        ++changes;
      last_on_femur = on_femur;
      const Poses& bodies = on_femur ? in_femur_ : in_tibia_;
      (on_femur ? path.femur : path.tibia).push_back(bodies.at(place.body) * place.X * point.at);
    }
    if (!starts_on_femur) {
      std::reverse(path.femur.begin(), path.femur.end());
      std::reverse(path.tibia.begin(), path.tibia.end());
    }
    return changes == 1;
  }

  void note(const std::string& what, const std::vector<std::string>& names) {
    if (names.empty()) return;
    out_.notes.push_back(fmt::format("{} {} {}: {}", names.size(),
                                     names.size() == 1 ? "strand" : "strands", what,
                                     fmt::join(names, ", ")));
  }

  const OsimModel& model_;
  const OsimFrames& frames_;
  const Poses &in_femur_, &in_tibia_;
  const RigidTransform X_FT_;
  std::vector<std::string> straightened_, shortened_, left_out_, never_free_;
  OsimStrands out_;
};

}  // namespace

OsimPlace place_of(const OsimFrames& frames,
                   const OsimLigament& ligament,
                   const OsimPathPoint& point) {
  return frames.find(point.frame, point.path, "Blankevoort1991Ligament \"" + ligament.name + "\"");
}

OsimStrands find_strands(const OsimModel& model, const OsimFrames& frames, const OsimBones& bones) {
  StrandFinder finder(model, frames, bones);
  for (const OsimLigament& ligament : model.ligaments) finder.add(ligament);
  return finder.result();
}

}  // namespace condyle
