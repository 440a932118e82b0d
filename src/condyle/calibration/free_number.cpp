/// The numbers of a knee that are free, be it in a fit or in a study (free_parameter.h).

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "condyle/calibration/bone_triad.h"
#include "condyle/calibration/free_parameter.h"
#include "condyle/input_error.h"
#include "condyle/scene/ligament_number.h"

namespace condyle {
namespace {

using Eigen::Vector3d;

bool is_factor(ParameterKind kind) {
  return kind == ParameterKind::kStiffness || kind == ParameterKind::kLoadScale;
}

const std::string& owner_of(const Scene& scene, ParameterKind kind, std::size_t index) {
  return kind == ParameterKind::kLoadScale ? scene.loads[index].name : scene.ligaments[index].name;
}

/// "MCLs*" where these are all ligaments whose names begin so; else empty.
std::string bundle_of(const Scene& scene, const CalibrationParameter& asked) {
  if (asked.what == ParameterKind::kLoadScale) return {};
  std::string begin = scene.ligaments[static_cast<std::size_t>(asked.of.front())].name;
  const auto begins = [&](const std::string& name) {
    return name.compare(0, begin.size(), begin) == 0;
  };
  for (const int i : asked.of)
    while (!begins(scene.ligaments[static_cast<std::size_t>(i)].name)) begin.pop_back();
  const auto count =
      std::count_if(scene.ligaments.begin(), scene.ligaments.end(),
                    [&](const LigamentDescription& ligament) { return begins(ligament.name); });
  return count == static_cast<std::ptrdiff_t>(asked.of.size()) ? begin + "*" : "";
}

/// Names of ligaments in one: "aACL+pACL", "MCLs*", or the first and how many more.
std::string owners(const Scene& scene, const CalibrationParameter& asked) {
  constexpr std::size_t kMost = 3;
  if (asked.of.size() > kMost)
    if (std::string bundle = bundle_of(scene, asked); !bundle.empty()) return bundle;
  std::string name;
  for (std::size_t i = 0; i < std::min(asked.of.size(), kMost); ++i)
    name += (i > 0 ? "+" : "") + owner_of(scene, asked.what, static_cast<std::size_t>(asked.of[i]));
  return asked.of.size() > kMost ? fmt::format("{}+{} more", name, asked.of.size() - kMost) : name;
}

/// Refuses numbers that the scene does not have, and those that are free already.
class Taken {
 public:
  Taken(const Scene& scene, const std::string& where) : scene_(scene), where_(where) {}

  void take(const CalibrationParameter& asked) {
    for (const int of : asked.of) take_one(asked, static_cast<std::size_t>(of));
  }

  /// Whether that slack length is free, as such or by its strain.
  [[nodiscard]] bool has(ParameterKind kind, int ligament) const {
    return taken_.contains({kind, ligament, -1});
  }

  [[noreturn]] void refuse(const std::string& message) const {
    throw InputError(fmt::format("{} {}", where_, message));
  }

 private:
  void take_one(const CalibrationParameter& asked, std::size_t index) {
    const std::string name =
        fmt::format("{}.{}", owner_of(scene_, asked.what, index), word_of(asked.what));
    if (asked.what != ParameterKind::kLoadScale &&
        !has_number(scene_.ligaments[index].law, asked.what))
      refuse(name + ": its law has none, expected " + laws_with(asked.what));
    const bool strain = asked.what == ParameterKind::kReferenceStrain;
    const ParameterKind same =
        strain ? ParameterKind::kSlackLength : ParameterKind::kReferenceStrain;
    const bool length = strain || asked.what == ParameterKind::kSlackLength;
    const int body = asked.what == ParameterKind::kInsertion ? asked.body : -1;
    const int of = static_cast<int>(index);
    if ((length && has(same, of)) || !taken_.insert({asked.what, of, body}).second)
      refuse(name + " is free twice, expected once");
  }

  const Scene& scene_;
  const std::string& where_;
  std::set<std::tuple<ParameterKind, int, int>> taken_;
};

class Maker {
 public:
  Maker(const Scene& scene,
        const std::vector<CalibrationParameter>& all,
        const std::vector<TriangleMesh>& meshes,
        const std::string& where)
      : scene_(scene), meshes_(meshes), taken_(scene, where) {
    for (const CalibrationParameter& asked : all) taken_.take(asked);
    for (const CalibrationParameter& asked : all) {
      const std::size_t before = parameters.size();
      add(asked);
      const auto place = static_cast<std::size_t>(&asked - all.data());
      for (std::size_t j = before; j < parameters.size(); ++j) parameters[j].asked = place;
    }
  }

  std::vector<FreeParameter> parameters;

 private:
  void add(const CalibrationParameter& asked) {
    if (asked.what == ParameterKind::kInsertion) return add_insertions(asked);
    if (asked.together) return add_number(asked, asked.of, owners(scene_, asked));
    for (const int of : asked.of)
      add_number(asked, {of}, owner_of(scene_, asked.what, static_cast<std::size_t>(of)));
  }

  [[nodiscard]] double number(const CalibrationParameter& asked, int of) const {
    if (asked.what == ParameterKind::kLoadScale) return 1;
    return number_of(scene_, scene_.ligaments[static_cast<std::size_t>(of)], asked.what);
  }

  void add_number(const CalibrationParameter& asked,
                  const std::vector<int>& of,
                  const std::string& owner) {
    FreeParameter& made = parameters.emplace_back();
    made.name = fmt::format("{}.{}", owner, word_of(asked.what));
    made.units = asked.what == ParameterKind::kSlackLength ? "mm" : "1";
    made.logarithmic = is_factor(asked.what);
    made.prior_sd = asked.prior_sd;
    for (const int each : of) {
      made.moves.push_back({{.kind = asked.what, .index = static_cast<std::size_t>(each)}, 1});
      narrow(asked, number(asked, each), made);
    }
    made.together = of.size() > 1;
    made.start = made.together ? 0 : number(asked, of.front());
  }

  /// To where this number is within bounds; a transition strain stays above a tenth of itself. Numbers on wraps that
  /// are fitted to bone were not known when the scene was read.
  void narrow(const CalibrationParameter& asked, double number, FreeParameter& made) const {
    auto& [lower, upper] = made.bounds;
    if (asked.what == ParameterKind::kTransitionStrain) lower = std::max(lower, -0.9 * number);
    if (!asked.bounds) return;
    const auto [least, most] = *asked.bounds;
    if (!made.logarithmic && !(least < number && number < most))
      taken_.refuse(fmt::format(
          "{}: bounds = [{:.6g}, {:.6g}], expected bounds about the scene's own value, {:.6g}{}",
          made.name, least, most, number, made.units == "1" ? "" : " (all in " + made.units + ")"));
    lower = std::max(lower, made.logarithmic ? std::log(least) : least - number);
    upper = std::min(upper, made.logarithmic ? std::log(most) : most - number);
  }

  [[nodiscard]] const Attachment& end_on(int ligament, int body) const {
    const auto& ends = scene_.ligaments[static_cast<std::size_t>(ligament)].ends;
    return ends[ends[0].body == body ? 0 : 1];
  }

  /// Normal of the bone at these insertions; empty where there is no mesh or they look everywhere.
  [[nodiscard]] std::optional<Vector3d> normal_at(const std::vector<int>& of, int body) const {
    const auto index = static_cast<std::size_t>(body);
    if (index >= meshes_.size()) return std::nullopt;
    Vector3d sum = Vector3d::Zero();
    for (const int each : of) {
      const std::optional<Vector3d> n = bone_normal(meshes_[index], end_on(each, body).at);
      if (!n) return std::nullopt;
      sum += *n;
    }
    const bool one_side = sum.norm() > 0.5 * static_cast<double>(of.size());
    return one_side ? std::optional<Vector3d>(sum.normalized()) : std::nullopt;
  }

  /// Anterior, proximal, lateral of a bone; x, y, z of a body without anatomical axes.
  [[nodiscard]] Eigen::Matrix3d axes_of(int body) const {
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    if (scene_.joint)
      for (const AnatomicalFrame& frame : {scene_.joint->femur, scene_.joint->tibia})
        if (frame.body == body) axes << frame.anterior, frame.proximal, frame.lateral;
    return axes;
  }

  void add_insertions(const CalibrationParameter& asked) {
    if (asked.together) return add_insertion(asked, asked.of, owners(scene_, asked));
    for (const int of : asked.of)
      add_insertion(asked, {of}, scene_.ligaments[static_cast<std::size_t>(of)].name);
  }

  void add_insertion(const CalibrationParameter& asked,
                     const std::vector<int>& of,
                     const std::string& owner) {
    const std::optional<Vector3d> n = normal_at(of, asked.body);
    const Eigen::Matrix3d triad =
        n ? triad_about(*n, axes_of(asked.body)) : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
    for (int i = 0; i < 3; ++i) {
      FreeParameter& made = parameters.emplace_back();
      constexpr const char* kOnBone[] = {"tangent_1", "tangent_2", "normal"};
      constexpr const char* kOfBody[] = {"x", "y", "z"};
      made.name = fmt::format("{}.insertion.{}.{}", owner,
                              scene_.bodies[static_cast<std::size_t>(asked.body)].name,
                              (n ? kOnBone : kOfBody)[i]);
      made.units = "mm";
      made.prior_sd = n && i == 2 ? asked.normal_sd.value_or(asked.prior_sd / 4) : asked.prior_sd;
      made.together = of.size() > 1;
      if (asked.bounds) made.bounds = *asked.bounds;
      for (const int each : of) add_moves(each, asked.body, triad.col(i), made);
    }
  }

  void add_moves(int ligament, int body, const Vector3d& direction, FreeParameter& made) const {
    const OfBody of = body == scene_.fixed_body() ? OfBody::kFixed : OfBody::kMoving;
    for (int c = 0; c < 3; ++c)
      if (direction[c] != 0)
        made.moves.push_back({{.kind = ParameterKind::kInsertion,
                               .index = static_cast<std::size_t>(ligament),
                               .body = of,
                               .component = c,
                               .held = held(ligament)},
                              direction[c]});
  }

  /// What stays while an insertion of it moves: what else is free of it has the last word.
  [[nodiscard]] Held held(int ligament) const {
    if (taken_.has(ParameterKind::kSlackLength, ligament)) return Held::kSlackLength;
    const bool strain = taken_.has(ParameterKind::kReferenceStrain, ligament) ||
                        scene_.ligaments[static_cast<std::size_t>(ligament)].reference_strain;
    return strain ? Held::kReferenceStrain : Held::kSlackLength;
  }

  const Scene& scene_;
  const std::vector<TriangleMesh>& meshes_;
  Taken taken_;
};

}  // namespace

std::vector<FreeParameter> free_numbers(const Scene& scene,
                                        const std::vector<CalibrationParameter>& asked,
                                        const std::vector<TriangleMesh>& meshes,
                                        const std::string& where) {
  return std::move(Maker(scene, asked, meshes, where).parameters);
}

}  // namespace condyle
