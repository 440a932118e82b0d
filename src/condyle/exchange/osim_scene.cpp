#include "condyle/exchange/osim_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <system_error>

#include "condyle/contact/layer_options.h"
#include "condyle/exchange/stl_run.h"
#include "condyle/file_ending.h"
#include "condyle/input_error.h"
#include "condyle/math/rotation.h"
#include "condyle/mesh_files/load_mesh.h"
#include "condyle/scene_file/read_scene.h"
#include "condyle/scene_file/scene_words.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;

/// Twelve digits: 1e-10 mm in a knee, and no noise of a conversion from m.
std::string number(double value) { return fmt::format("{:.12g}", value + 0.0); }
std::string numbers(const Vector3d& v) {
  return fmt::format("[{}, {}, {}]", number(v.x()), number(v.y()), number(v.z()));
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
    for (const OsimPlacedWrap& wrap : knee_.wraps) add_wrap(wrap);
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
    std::string text = fmt::format(
        "title = {}\n{}\n", scene_string(fmt::format("{}, {} knee", model_.name, side())),
        scene_comment(fmt::format(
            "From {}, joint {}. Not in this scene:", file_.filename().string(), knee_.joint)));
    for (const std::string& note : out_.notes) text += scene_comment("- " + note) + "\n";
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
    const std::string ending = file_ending(mesh.file);
    return ending == ".stl" || ending == ".obj" || ending == ".ply" || ending == ".off";
  }

  /// The unit that a scale from the file's numbers to m stands for; empty where there is none.
  [[nodiscard]] static std::string unit(const Vector3d& scale) {
    for (const auto& [factor, name] : {std::pair{1.0, "m"}, {0.01, "cm"}, {0.001, "mm"}})
      if ((scale - Vector3d::Constant(factor)).norm() < 1e-9 * factor) return name;
    return "";
  }

  /// Stands in its body as it is in the file.
  [[nodiscard]] static bool unmoved(const OsimPlacedMesh& placed) {
    return !unit(placed.mesh.scale).empty() && placed.X.p.isZero(1e-9) &&
           (placed.X.R - Eigen::Matrix3d::Identity()).isZero(1e-12);
  }

  void add_mesh(const OsimPlacedMesh& placed) {
    out_.used.push_back(found(placed.mesh));
    line("mesh = {}",
         scene_string(mesh_path_in(scene_, unmoved(placed) ? found(placed.mesh) : moved(placed))));
    line("mesh_units = \"{}\"", unmoved(placed) ? unit(placed.mesh.scale) : "mm");
  }

  /// The file that will hold the mesh where the model puts it.
  fs::path moved(const OsimPlacedMesh& placed) {
    const auto known = moved_.find(placed.mesh.path);
    if (known != moved_.end()) return known->second;
    const fs::path folder = scene_.has_parent_path() ? scene_.parent_path() : fs::path(".");
    const std::string stem = scene_.stem().string() + "_" + file_word(placed.mesh.name);
    fs::path path = folder / (stem + ".ply");
    const auto taken = [&] {
      return std::any_of(moved_.begin(), moved_.end(),
                         [&](const auto& entry) { return entry.second == path; });
    };
    for (int k = 2; taken(); ++k) path = folder / fmt::format("{}_{}.ply", stem, k);
    moved_[placed.mesh.path] = path;
    out_.meshes.push_back({path, placed_mesh(placed)});
    return path;
  }

  /// Scaled, then moved; a scale that mirrors turns the triangles round.
  [[nodiscard]] TriangleMesh placed_mesh(const OsimPlacedMesh& placed) const {
    const Vector3d& scale = placed.mesh.scale;
    const double largest = scale.cwiseAbs().maxCoeff();
    TriangleMesh mesh = load_mesh(found(placed.mesh), 1e3 * largest);
    for (Vector3d& v : mesh.vertices) v = placed.X * Vector3d((scale / largest).cwiseProduct(v));
    if (scale.prod() < 0)
      for (std::array<int, 3>& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
    return mesh;
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
    if (!sized(mesh)) {
      throw InputError(fmt::format("{}scale_factors = {:g} {:g} {:g}, expected none that is 0", who,
                                   mesh.scale.x(), mesh.scale.y(), mesh.scale.z()));
    }
  }

  [[nodiscard]] static bool sized(const OsimMesh& mesh) {
    return mesh.scale.allFinite() && (mesh.scale.array() != 0).all();
  }

  void add_bone(const OsimBody& body) {
    if (!body.bone) return;
    const OsimMesh& mesh = body.bone->mesh;
    if (readable(mesh) && !found(mesh).empty() && sized(mesh)) return add_mesh(*body.bone);
    out_.notes.push_back(fmt::format(
        "the bone mesh {}: not found, or of another format than stl, obj, ply, off", mesh.file));
  }

  void add_bodies() {
    line("\n[[body]]\nname = \"femur\"                   {}\nfixed = true",
         scene_comment(knee_.femur.name));
    add_bone(knee_.femur);
    line("\n[[body]]\nname = \"tibia\"                   {}", scene_comment(knee_.tibia.name));
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

  void add_surface(const char* compartment, const char* part, const OsimPlacedMesh& placed) {
    const OsimMesh& mesh = placed.mesh;
    check_contact_mesh(mesh);
    line("\n[[surface]]\nname = \"{} {}\"                   {}\nbody = \"{}\"\nkind = \"patch\"",
         compartment, part, scene_comment(mesh.name),
         std::string(part) == "condyle" ? "femur" : "tibia");
    line("compartment = \"{}\"", compartment);
    add_mesh(placed);
    if (!(mesh.modulus > 0)) return;
    line("modulus = {}", number(mesh.modulus));
    const double most = mesh.layer > 0 ? kGreatestLayerPoisson : 0.499;
    line("poisson = {}", number(std::min(mesh.poisson, most)));
    if (mesh.layer > 0) line("layer = {}", number(mesh.layer));
    if (mesh.poisson > most)
      out_.notes.push_back(
          fmt::format("poissons_ratio = {:g} of {}: taken as {:g}, since nearer to "
                      "0.5 a confined layer is a rigid one",
                      mesh.poisson, mesh.name, most));
  }

  static bool has_layer(const OsimMesh& mesh) { return mesh.modulus > 0 && mesh.layer > 0; }

  /// The model's own law, an elastic foundation, where both layers that it names are known.
  void add_law(const OsimPair& pair) {
    const OsimMesh &a = pair.femur.mesh, &b = pair.tibia.mesh;
    const bool half = (a.modulus > 0 && !has_layer(a)) || (b.modulus > 0 && !has_layer(b));
    if (half || (!has_layer(a) && !has_layer(b))) return;
    line("law = \"layer\"");
    if (pair.logarithmic) line("pressure = \"logarithmic\"");
  }

  void add_contacts() {
    for (const auto& [compartment, name] :
         {std::pair{Compartment::kMedial, "medial"}, {Compartment::kLateral, "lateral"}}) {
      for (const OsimPair& pair : knee_.contacts) {
        if (pair.compartment.value_or(compartment) != compartment) continue;
        add_surface(name, "condyle", pair.femur);
        add_surface(name, "plateau", pair.tibia);
        line("\n[[contact]]\nname = \"{0}\"\nsurfaces = [\"{0} condyle\", \"{0} plateau\"]", name);
        add_law(pair);
      }
    }
  }

  void add_wrap(const OsimPlacedWrap& placed) {
    const OsimWrap& wrap = placed.wrap;
    line("\n[[wrap]]\nname = {}\nbody = \"{}\"", scene_string(wrap.name),
         placed.on_femur ? "femur" : "tibia");
    const std::string center = numbers(placed.X.p), axis = numbers(placed.X.R.col(2));
    if (wrap.type == "WrapEllipsoid")
      line("kind = \"ellipsoid\"\ncenter = {}\naxes = {}\nsemi_axes = {}", center,
           numbers(log_rotation(placed.X.R) * 180 / M_PI), numbers(wrap.sizes));
    else if (wrap.type == "WrapTorus")
      line("kind = \"torus\"\ncenter = {}\naxis = {}\nmajor = {}\nminor = {}", center, axis,
           number(wrap.sizes.y()), number(wrap.sizes.x()));
    else if (wrap.type == "WrapCylinder")
      line("kind = \"cylinder\"\npoint = {}\naxis = {}\nradius = {}", center, axis,
           number(wrap.sizes.x()));
    else
      line("kind = \"sphere\"\ncenter = {}\nradius = {}", center, number(wrap.sizes.x()));
  }

  /// An end within a surface of its own bone leaves that out, as OpenSim does.
  void add_path(const OsimStrand& strand) {
    if (strand.wraps.empty()) return;
    std::string names, sides;
    bool all = true;
    for (const std::size_t index : strand.wraps) {
      const OsimPlacedWrap& placed = knee_.wraps[index];
      names += (names.empty() ? "" : ", ") + scene_string(placed.wrap.name);
      all &= placed.side.has_value();
      if (placed.side) sides += (sides.empty() ? "" : ", ") + numbers(*placed.side);
    }
    line("wraps = [{}]\ninside = \"straight\"", names);
    if (all) line("side = [{}]", sides);
    if (!all && !sides.empty())
      out_.notes.push_back(
          fmt::format("the quadrants of the wrap objects of {}: not all have one", strand.name));
  }

  void add_ligament(const OsimStrand& strand) {
    line("\n[[ligament]]\nname = {}", scene_string(strand.name));
    line("ends = [ {{ body = \"femur\", at = {} }},\n         {{ body = \"tibia\", at = {} }} ]",
         numbers(strand.femur), numbers(strand.tibia));
    line("law = \"toe-linear\"\nstiffness = {}\ntransition_strain = {}\nslack_length = {}",
         number(strand.stiffness), number(strand.transition_strain), number(strand.slack_length));
    add_path(strand);
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
  std::map<std::string, fs::path> moved_;  ///< by the path of the mesh in the model
  OsimScene out_;
};

/// What is written can be read. Where it cannot, a number of the model is to blame, not a line of a scene that nobody has.
void expect_readable(const OsimScene& made, const fs::path& model, const fs::path& scene) {
  try {
    (void)parse_scene(made.text, scene);
  } catch (const InputError& error) {
    std::string words = error.what();
    const std::string place = scene.string() + ":";
    if (words.starts_with(place)) words.erase(0, words.find(": ", place.size()) + 2);
    throw InputError(fmt::format("{}: makes no scene: {}", model.string(), words));
  }
}

}  // namespace

OsimScene osim_scene(const OsimModel& model,
                     const OsimKnee& knee,
                     const fs::path& file,
                     const fs::path& scene,
                     const OsimSceneOptions& options) {
  OsimScene made = SceneText(model, knee, file, scene, options).scene();
  expect_readable(made, file, scene);
  return made;
}

}  // namespace condyle
