#include "condyle/exchange/osim_strands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
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
  StrandFinder(const OsimFrames& frames, const Poses& in_femur, const Poses& in_tibia)
      : frames_(frames), in_femur_(in_femur), in_tibia_(in_tibia) {}

  void add(const OsimLigament& ligament) {
    Crossing path;
    const double taut = find_crossing(ligament, path)
                            ? ligament.slack_length - length(path.femur) - length(path.tibia)
                            : 0;
    if (!(taut > 0)) {
      left_out_.push_back(ligament.name);
      return;
    }
    if (ligament.wraps) straightened_.push_back(ligament.name);
    if (taut < ligament.slack_length) shortened_.push_back(ligament.name);
    const double part = taut / ligament.slack_length;
    out_.strands.push_back({ligament.name, path.femur.back(), path.tibia.front(),
                            ligament.stiffness * part, ligament.transition_strain / part, taut});
  }

  [[nodiscard]] OsimStrands result() {
    note("with a wrap object, taken as straight lines", straightened_);
    note("with points along a bone, replaced by their free part", shortened_);
    note("to other bones, over both bones twice, or without force", left_out_);
    out_.notes.emplace_back("damping of the ligaments");
    return std::move(out_);
  }

 private:
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

  const OsimFrames& frames_;
  const Poses &in_femur_, &in_tibia_;
  std::vector<std::string> straightened_, shortened_, left_out_;
  OsimStrands out_;
};

}  // namespace

OsimPlace place_of(const OsimFrames& frames,
                   const OsimLigament& ligament,
                   const OsimPathPoint& point) {
  return frames.find(point.frame, point.path, "Blankevoort1991Ligament \"" + ligament.name + "\"");
}

OsimStrands find_strands(const OsimModel& model,
                         const OsimFrames& frames,
                         const Poses& in_femur,
                         const Poses& in_tibia) {
  StrandFinder finder(frames, in_femur, in_tibia);
  for (const OsimLigament& ligament : model.ligaments) finder.add(ligament);
  return finder.result();
}

}  // namespace condyle
