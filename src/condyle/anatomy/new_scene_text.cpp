#include "condyle/anatomy/new_scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <variant>

#include "condyle/math/degree.h"
#include "condyle/math/rotation.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/scene_file/scene_words.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

constexpr const char* kNoFile = "new.toml";  // what a scene without a file is called

/// To a tenth, never "-0.0".
std::string degrees(double angle) {
  return fmt::format("{:.1f}", std::round(10 * angle / kDegree) / 10 + 0.0);
}

/// To 1e-4 mm, without the zeros behind.
std::string number(double value) {
  std::string text = fmt::format("{:.4f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}
/// As the template has it, without unit: to 1e-9 of itself.
std::string ratio(double value) { return fmt::format("{:.9g}", value); }
std::string point(const Vector3d& v) {
  return fmt::format("[{}, {}, {}]", number(v.x()), number(v.y()), number(v.z()));
}
std::string direction(const Vector3d& v) {
  return fmt::format("[{:.12f}, {:.12f}, {:.12f}]", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

class SceneText {
 public:
  SceneText(const NewKnee& knee, const fs::path& scene) : knee_(knee), scene_(scene) {}

  [[nodiscard]] std::string text() {
    add_head();
    add_bodies();
    add_joint();
    add_surfaces();
    add_wraps();
    add_ligaments();
    add_motion();
    return std::move(text_);
  }

 private:
  template <typename... T>
  void line(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<T>(values)...);
    text_ += '\n';
  }
  void say(const std::string& remark) { line("{}", scene_comment(remark)); }

  [[nodiscard]] bool right() const { return knee_.shape.side == Side::kRight; }

  void add_head() {
    const Scene& from = knee_.model.scene;
    line("title = {}", scene_string(fmt::format(
                           "{} and {}, {} knee", knee_.files.femur.filename().string(),
                           knee_.files.tibia.filename().string(), right() ? "right" : "left")));
    say("Made by condyle new from the meshes below. Ligaments, loads: template \"" + from.title +
        "\".");
    say(fmt::format("Side: {} ({}).", side_in_words(knee_.shape), knee_.shape.side_evidence));
    if (!knee_.doubts.empty()) say("To look at:");
    for (const std::string& doubt : knee_.doubts) say("- " + doubt);
    line("\n[units]\nlength = \"mm\"\nangle = \"deg\"\nforce = \"N\"");
  }

  void add_mesh(const fs::path& file) {
    line("mesh = {}", scene_string(mesh_path_in(scene_, file)));
    if (knee_.shape.to_mm != 1) line("mesh_units = {}", scene_string(unit_name(knee_.shape.to_mm)));
  }

  void add_bodies() {
    line("\n[[body]]\nname = \"femur\"\nfixed = true");
    add_mesh(knee_.files.femur);
    line("\n[[body]]\nname = \"tibia\"");
    add_mesh(knee_.files.tibia);
    const NewStart& start = knee_.start;
    say(fmt::format(
        "The start pose sets the slack lengths. Scan: flexion {}, adduction {}, internal "
        "rotation {} degrees, gaps {:.2f} mm medial and {:.2f} lateral{};",
        degrees(start.scan.flexion), degrees(start.scan.adduction),
        degrees(start.scan.internal_rotation), start.gaps[0], start.gaps[1],
        start.extended != 0 ? " once at the template's flexion" : ""));
    say(
        fmt::format("since then flexed by {} degrees, {:.2f} mm along the tibia, adducted by "
                    "{} degrees.",
                    degrees(-start.extended), start.shifted, degrees(start.tilted)));
    line("start.translation = {}", direction(start.X_FT.p));
    line("start.rotation = {}", direction(log_rotation(start.X_FT.R) / kDegree));
  }

  void add_frame(const char* name, const RecognisedBone& bone) {
    say(fmt::format("{}: {}", name, bone.rule));
    line("{} = {{ body = \"{}\", origin = {}, lateral = {}, anterior = {}, proximal = {} }}", name,
         name, point(bone.frame.origin), direction(bone.frame.lateral),
         direction(bone.frame.anterior), direction(bone.frame.proximal));
  }
  void add_joint() {
    line("\n[joint]\nside = \"{}\"", right() ? "right" : "left");
    add_frame("femur", knee_.shape.femur);
    add_frame("tibia", knee_.shape.tibia);
  }

  void add_surface(std::size_t compartment, bool femoral) {
    const char* side = compartment == 0 ? "medial" : "lateral";
    line("\n[[surface]]\nname = \"{} {}\"\nbody = \"{}\"\nkind = \"patch\"\ncompartment = \"{}\"",
         side, femoral ? "condyle" : "plateau", femoral ? "femur" : "tibia", side);
    const std::vector<fs::path>& cartilage = knee_.files.cartilage;
    if (!cartilage.empty())
      add_mesh(cartilage[femoral ? 0 : static_cast<std::size_t>(tibial_file(compartment))]);
    const double offset = knee_.start.offset[2 * compartment + (femoral ? 0 : 1)];
    if (offset > 0) line("offset = {}                # in place of cartilage", number(offset));
    if (offset > 0 && femoral)
      line("region = {{ least_cosine = 0 }}                # bone may touch beside the eminence");
  }
  [[nodiscard]] int tibial_file(std::size_t compartment) const {
    return knee_.files.cartilage.size() > 2 ? knee_.tibial_file[compartment] : 1;
  }

  void add_surfaces() {
    for (const std::size_t compartment : {std::size_t{0}, std::size_t{1}})
      for (const bool femoral : {true, false}) add_surface(compartment, femoral);
    for (const char* side : {"medial", "lateral"})
      line("\n[[contact]]\nname = \"{0}\"\nsurfaces = [\"{0} condyle\", \"{0} plateau\"]", side);
  }

  [[nodiscard]] std::string end(const NewLigament& ligament, std::size_t k) const {
    return fmt::format("{{ body = \"{}\", at = {} }}", ligament.on_femur[k] ? "femur" : "tibia",
                       point(ligament.ends[k].at));
  }

  void add_path(const NewLigament& ligament, const LigamentDescription& from) {
    std::string names;
    for (const int wrap : wraps_of(ligament))
      names += (names.empty() ? "" : ", ") +
               scene_string(knee_.model.scene.wraps[static_cast<std::size_t>(wrap)].name);
    if (names.empty()) return;
    line("wraps = [{}]", names);
    if (!from.path.anchors_inside) line("inside = \"straight\"");
    if (from.path.thickness > 0) line("thickness = {}", number(from.path.thickness));
  }

  void add_law(const LigamentDescription& from, double strain) {
    if (const auto* law = std::get_if<ToeLinearLaw>(&from.law))
      line("law = \"toe-linear\"\nstiffness = {}\ntransition_strain = {}", ratio(law->stiffness),
           ratio(law->transition_strain));
    else
      line("law = \"quadratic\"\nstiffness = {}",
           ratio(std::get<QuadraticLaw>(from.law).stiffness));
    line("reference_strain = {}", ratio(strain));
  }

  /// Of the template, on the new bones.
  [[nodiscard]] std::vector<int> wraps_of(const NewLigament& ligament) const {
    if (!knee_.wraps || !ligament.on_bone) return {};
    return knee_.model.scene.ligaments[static_cast<std::size_t>(ligament.of_template)].path.wraps;
  }

  /// Those that a ligament uses.
  void add_wraps() {
    const Scene& scene = knee_.model.scene;
    std::set<int> used;
    for (const NewLigament& ligament : knee_.ligaments)
      for (const int wrap : wraps_of(ligament)) used.insert(wrap);
    for (const int wrap : used) {
      const WrapDescription& from = scene.wraps[static_cast<std::size_t>(wrap)];
      line("\n[[wrap]]\nname = {}\nbody = \"{}\"\nkind = \"ellipsoid\"\nfit = \"bone\"",
           scene_string(from.name), from.body == scene.joint->femur.body ? "femur" : "tibia");
      add_leading(wrap, *from.fit);
    }
  }

  /// Of a wrap that the template fits to some of its ligaments only: those of them that there are.
  void add_leading(int wrap, const BoneFit& fit) {
    std::string names;
    bool all = true;
    for (const NewLigament& ligament : knee_.ligaments) {
      const std::vector<int> wraps = wraps_of(ligament);
      if (std::find(wraps.begin(), wraps.end(), wrap) == wraps.end()) continue;
      const bool leads = std::find(fit.ligaments.begin(), fit.ligaments.end(),
                                   ligament.of_template) != fit.ligaments.end();
      all = all && leads;
      if (leads) names += (names.empty() ? "" : ", ") + scene_string(name_of(ligament));
    }
    if (!all && !names.empty()) line("ligaments = [{}]", names);
  }

  [[nodiscard]] const std::string& name_of(const NewLigament& ligament) const {
    return knee_.model.scene.ligaments[static_cast<std::size_t>(ligament.of_template)].name;
  }

  void add_ligaments() {
    line("");
    say("Ligaments: stiffness and strain at the start pose are the template's. Behind each end: "
        "how far its");
    say("place is from where frames and size alone would put it, and how sure it is (one standard "
        "deviation).");
    for (const NewLigament& ligament : knee_.ligaments) {
      const LigamentDescription& from =
          knee_.model.scene.ligaments[static_cast<std::size_t>(ligament.of_template)];
      line("\n[[ligament]]\nname = {}", scene_string(from.name));
      line("ends = [ {},  # moved {:.1f} mm, ±{:.1f}", end(ligament, 0), ligament.ends[0].moved,
           ligament.ends[0].uncertainty);
      line("         {} ]  # moved {:.1f} mm, ±{:.1f}", end(ligament, 1), ligament.ends[1].moved,
           ligament.ends[1].uncertainty);
      add_path(ligament, from);
      add_law(from, ligament.strain);
    }
  }

  /// A direction or, with the size of the bone, a place, from a bone of the template to the new one.
  [[nodiscard]] static Vector3d carried(const BoneFrame& from,
                                        const BoneFrame& to,
                                        const Vector3d& v) {
    return to.vector(from.components(v));
  }

  void add_load(const LoadDescription& load) {
    const JointDescription& joint = *knee_.model.scene.joint;
    const bool femur = load.body == joint.femur.body;
    const RecognisedKnee& old = knee_.model.shape;
    const BoneFrame &from = femur ? old.femur.frame : old.tibia.frame,
                    &to = femur ? knee_.shape.femur.frame : knee_.shape.tibia.frame;
    const Vector3d& size = femur ? knee_.femur.size : knee_.tibia.size;
    // Directions of a dead load are those of the fixed body's file.
    Vector3d vector = load.follows_body
                          ? carried(from, to, load.vector)
                          : carried(old.femur.frame, knee_.shape.femur.frame, load.vector);
    if (load.moment && old.side != knee_.shape.side) vector = -vector;  // a pseudovector
    line("\n[[load]]\nname = {}\nbody = \"{}\"\nkind = \"{}\"\nvector = {}",
         scene_string(load.name), femur ? "femur" : "tibia", load.moment ? "moment" : "force",
         point(vector));
    if (load.follows_body) line("follows = \"body\"");
    if (load.scale != 1) line("scale = {}", load.scale);
    if (load.moment) return;
    const Vector3d c = from.components(load.at - from.origin).cwiseProduct(size);
    line("at = {}", point(to.origin + to.vector(c)));
  }

  void add_motion() {
    line("\n[[condition]]\nname = \"flexion\"\nkind = \"flexion\"\nvalue = 0");
    for (const LoadDescription& load : knee_.model.scene.loads) add_load(load);
    line("\n[sweep]\nvary = \"flexion\"\nfrom = 0\nto = 120\nstep = 5");
  }

  const NewKnee& knee_;
  const fs::path& scene_;
  std::string text_;
};

}  // namespace

std::string new_scene_text(const NewKnee& knee, const fs::path& scene) {
  return SceneText(knee, scene).text();
}

Scene scene_of(const NewKnee& knee) { return parse_scene(new_scene_text(knee, kNoFile), kNoFile); }

std::string without_file(std::string error) {
  if (error.starts_with(std::string(kNoFile) + ":")) error.erase(0, error.find(": ") + 2);
  return error;
}

}  // namespace condyle
