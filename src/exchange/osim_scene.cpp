#include "exchange/osim_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <system_error>

#include "input_error.h"
#include "math/rotation.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

/// Twelve digits: 1e-10 mm in a knee, and no noise of a conversion from m.
std::string number(double value) { return fmt::format("{:.12g}", value + 0.0); }
std::string numbers(const Vector3d& v) {
  return fmt::format("[{}, {}, {}]", number(v.x()), number(v.y()), number(v.z()));
}
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result + '"';
}

class SceneText {
 public:
  SceneText(const OsimModel& model,
            const OsimKnee& knee,
            const fs::path& file,
            const fs::path& scene,
            const OsimSceneOptions& options)
      : model_(model), knee_(knee), file_(file), scene_(scene), options_(options) {
    out_.notes = knee.notes;
  }

  [[nodiscard]] OsimScene scene() {
    add_bodies();
    add_joint();
    add_contacts();
    for (const OsimStrand& strand : knee_.ligaments) add_ligament(strand);
    add_motion();
    out_.text = head() + body_;
    return std::move(out_);
  }

 private:
  template <typename... T>
  void line(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(body_), format, std::forward<T>(values)...);
    body_ += '\n';
  }

  [[nodiscard]] std::string head() const {
    std::string text = fmt::format("title = {}\n# From {}, joint {}. Not in this scene:\n",
                                   quoted(fmt::format("{}, {} knee", model_.name, side())),
                                   file_.filename().string(), knee_.joint);
    for (const std::string& note : out_.notes) text += "# - " + note + "\n";
    return text + "\n[units]\nlength = \"mm\"\nangle = \"deg\"\nforce = \"N\"\n";
  }

  [[nodiscard]] const char* side() const { return knee_.side == Side::kRight ? "right" : "left"; }

  /// The file of a mesh, or nothing.
  [[nodiscard]] fs::path found(const OsimMesh& mesh) const {
    const fs::path folder = file_.has_parent_path() ? file_.parent_path() : fs::path(".");
    for (const fs::path& path : {folder / mesh.file, folder / "Geometry" / mesh.file}) {
      std::error_code error;
      if (fs::is_regular_file(path, error)) return path;
    }
    return {};
  }

  [[nodiscard]] static bool readable(const OsimMesh& mesh) {
    std::string ending = fs::path(mesh.file).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending == ".stl" || ending == ".obj" || ending == ".ply" || ending == ".off";
  }

  /// The unit that a scale from the file's numbers to m stands for; empty where there is none.
  [[nodiscard]] static std::string unit(const Vector3d& scale) {
    for (const auto& [factor, name] : {std::pair{1.0, "m"}, {0.01, "cm"}, {0.001, "mm"}})
      if ((scale - Vector3d::Constant(factor)).norm() < 1e-9 * factor) return name;
    return "";
  }

  [[nodiscard]] std::string relative(const fs::path& mesh) const {
    std::error_code error;
    const fs::path folder = scene_.has_parent_path() ? scene_.parent_path() : fs::path(".");
    const fs::path path = fs::relative(mesh, folder, error);
    return (error || path.empty() ? fs::absolute(mesh) : path).generic_string();
  }

  void add_mesh(const OsimMesh& mesh) {
    line("mesh = {}", quoted(relative(found(mesh))));
    line("mesh_units = \"{}\"", unit(mesh.scale));
  }

  void check_contact_mesh(const OsimMesh& mesh) const {
    const std::string who =
        fmt::format("{}: Smith2018ContactMesh \"{}\": ", file_.string(), mesh.name);
    if (!readable(mesh))
      throw InputError(
          fmt::format("{}mesh_file = {}, expected stl, obj, ply or off", who, mesh.file));
    if (found(mesh).empty()) {
      throw InputError(fmt::format(
          "{}mesh_file = {} is neither beside the model nor in the folder Geometry there", who,
          mesh.file));
    }
    if (unit(mesh.scale).empty()) {
      throw InputError(
          fmt::format("{}scale_factors = {:g} {:g} {:g}, expected 1, 0.01 or 0.001 "
                      "three times",
                      who, mesh.scale.x(), mesh.scale.y(), mesh.scale.z()));
    }
  }

  void add_bone(const OsimBody& body) {
    if (!body.bone) return;
    if (readable(*body.bone) && !found(*body.bone).empty() && !unit(body.bone->scale).empty())
      return add_mesh(*body.bone);
    out_.notes.push_back(fmt::format(
        "the bone mesh {}: not found, scaled, or of another format than stl, obj, ply, off",
        body.bone->file));
  }

  void add_bodies() {
    line("\n[[body]]\nname = \"femur\"                   # {}\nfixed = true", knee_.femur.name);
    add_bone(knee_.femur);
    line("\n[[body]]\nname = \"tibia\"                   # {}", knee_.tibia.name);
    add_bone(knee_.tibia);
    line("start.translation = {}", numbers(knee_.X_FT.p));
    line("start.rotation = {}", numbers(log_rotation(knee_.X_FT.R) * 180 / M_PI));
  }

  void add_joint() {
    line("\n[joint]\nside = \"{}\"", side());
    for (const OsimBody* body : {&knee_.femur, &knee_.tibia}) {
      const char* name = body == &knee_.femur ? "femur" : "tibia";
      line("{} = {{ body = \"{}\", origin = {}, lateral = {}, anterior = {}, proximal = {} }}",
           name, name, numbers(body->origin), numbers(body->lateral), numbers(body->anterior),
           numbers(body->proximal));
    }
  }

  void add_surface(const char* compartment, const char* part, const OsimMesh& mesh) {
    check_contact_mesh(mesh);
    line("\n[[surface]]\nname = \"{} {}\"                   # {}\nbody = \"{}\"\nkind = \"patch\"",
         compartment, part, mesh.name, std::string(part) == "condyle" ? "femur" : "tibia");
    line("compartment = \"{}\"", compartment);
    add_mesh(mesh);
    if (!(mesh.modulus > 0)) return;
    line("modulus = {}", number(mesh.modulus));
    line("poisson = {}", number(std::min(mesh.poisson, 0.499)));
    if (mesh.layer > 0) line("layer = {}", number(mesh.layer));
  }

  void add_contacts() {
    for (const auto& [compartment, name] :
         {std::pair{Compartment::kMedial, "medial"}, {Compartment::kLateral, "lateral"}}) {
      for (const OsimPair& pair : knee_.contacts) {
        if (pair.compartment.value_or(compartment) != compartment) continue;
        add_surface(name, "condyle", pair.femur);
        add_surface(name, "plateau", pair.tibia);
        line("\n[[contact]]\nname = \"{0}\"\nsurfaces = [\"{0} condyle\", \"{0} plateau\"]", name);
      }
    }
  }

  void add_ligament(const OsimStrand& strand) {
    line("\n[[ligament]]\nname = {}", quoted(strand.name));
    line("ends = [ {{ body = \"femur\", at = {} }},\n         {{ body = \"tibia\", at = {} }} ]",
         numbers(strand.femur), numbers(strand.tibia));
    line("law = \"toe-linear\"\nstiffness = {}\ntransition_strain = {}\nslack_length = {}",
         number(strand.stiffness), number(strand.transition_strain), number(strand.slack_length));
  }

  void add_motion() {
    line("\n[[condition]]\nname = \"flexion\"\nkind = \"flexion\"\nvalue = 0");
    if (options_.compression != 0) {
      line(
          "\n# In place of muscles and weight: it keeps the contacts closed.\n[[load]]\nname = "
          "\"compression\"\nbody = \"tibia\"\nkind = \"force\"");
      line("vector = {}", numbers(options_.compression * knee_.tibia.proximal));
      line("at = {}\nfollows = \"body\"", numbers(knee_.tibia.origin));
    }
    line("\n[sweep]\nvary = \"flexion\"\nfrom = 0\nto = {}\nstep = 5", number(options_.to));
  }

  const OsimModel& model_;
  const OsimKnee& knee_;
  fs::path file_, scene_;
  OsimSceneOptions options_;
  std::string body_;
  OsimScene out_;
};

}  // namespace

OsimScene osim_scene(const OsimModel& model,
                     const OsimKnee& knee,
                     const fs::path& file,
                     const fs::path& scene,
                     const OsimSceneOptions& options) {
  return SceneText(model, knee, file, scene, options).scene();
}

}  // namespace condyle
