#include "condyle/scene_file/read_scene.h"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "condyle/control_characters.h"
#include "condyle/input_error.h"
#include "condyle/math/rotation.h"
#include "condyle/scene_file/read_sections.h"

namespace condyle {
namespace {

Scene parse(const std::string& text, const std::filesystem::path& file, bool meshes_must_exist) {
  const Source source{file.string(), file.parent_path(), meshes_must_exist};
  const Value document = parse_document(text, source.file);
  const Section root(document, source, "");
  if (document.find("specimens") != nullptr)
    root.fail_with("is a study, expected a scene; condyle study sweeps the scenes that it names");
  Scene scene;
  scene.text = text;
  scene.file = file;
  scene.title = root.has("title") ? root.text("title", "a title") : file.stem().string();
  read_units(root, scene);
  read_bodies(root, scene);
  read_joint(root, scene);
  read_surfaces(root, scene);
  read_contacts(root, scene);
  read_wraps(root, scene);
  read_ligaments(root, scene);
  read_conditions(root, scene);
  read_loads(root, scene);
  read_sweep(root, scene);
  read_laxity(root, scene);
  read_simulation(root, scene);
  read_calibration(root, scene);
  root.finish();
  return scene;
}

}  // namespace

std::string text_of(const std::filesystem::path& file, const std::string& expected) {
  const std::string name = file.string();
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    throw InputError(name + ": no such file, expected " + expected);
  if (std::filesystem::is_directory(status))
    throw InputError(name + ": is a folder, expected " + expected);
  if (!std::filesystem::is_regular_file(status) && !std::filesystem::is_fifo(status))
    throw InputError(name + ": is neither a file nor a pipe, expected " + expected);
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream)
    throw InputError(name + ": cannot be read, expected " + expected + " that is not empty");
  if (text.str().starts_with("\x89HDF"))
    throw InputError(name + ": is a result (HDF5), expected " + expected +
                     "; condyle plot and condyle report show results");
  if (text.str().find('\0') != std::string::npos)
    throw InputError(name + ": holds bytes that are no text, expected " + expected);
  return text.str();
}

Scene read_scene(const std::filesystem::path& file) {
  return parse(text_of(file, "a scene (TOML)"), file, true);
}

Scene parse_scene(const std::string& text,
                  const std::filesystem::path& file,
                  bool meshes_must_exist) {
  return parse(text, file, meshes_must_exist);
}

const Choices<double>& length_units() {
  static const Choices<double> units = {{"mm", 1}, {"cm", 10}, {"m", 1000}};
  return units;
}

void read_units(const Section& root, Scene& scene) {
  const Section units = root.table("units", "a table [units] with length, angle and force");
  static const Choices<double> angles = {{"deg", M_PI / 180}, {"rad", 1}};
  static const Choices<double> forces = {{"N", 1}};
  scene.length_to_mm = units.choice("length", length_units());
  scene.angle_to_rad = units.choice("angle", angles);
  scene.force_to_n = units.choice("force", forces);
  units.finish();
}

std::string read_name(const Section& section, const std::vector<std::string>& taken) {
  constexpr std::ptrdiff_t kLongest = 100;
  std::string name = section.text("name", "a name");
  const auto characters = std::count_if(name.begin(), name.end(), [](unsigned char c) {
    return (c & 0xC0U) != 0x80U;  // the first byte of one (UTF-8)
  });
  if (characters > kLongest)
    section.fail("name", fmt::format("at most {} characters, here are {}", kLongest, characters));
  if (name.find('/') != std::string::npos || name == "." || name == "..")
    section.fail("name",
                 "a name without \"/\", other than \".\" and \"..\": groups of results have it");
  // Delete has always been taken, and is shown as \u007f.
  if (std::any_of(name.begin(), name.end(), [](char c) { return is_control(c) && c != 0x7f; }))
    section.fail("name", "a name without control characters");
  if (std::find(taken.begin(), taken.end(), name) != taken.end()) {
    section.fail("name", "a name that is not used twice");
  }
  return name;
}

std::optional<MeshFile> read_mesh_file(const Section& section, const Scene& scene) {
  const double to_mm =
      section.has("mesh_units") ? section.choice("mesh_units", length_units()) : scene.length_to_mm;
  if (!section.has("mesh")) {
    if (section.has("mesh_units")) section.fail("mesh_units", "a mesh beside it");
    return std::nullopt;
  }
  const std::filesystem::path path =
      section.source().folder / section.text("mesh", "the path of a mesh");
  std::error_code error;
  if (section.source().meshes_must_exist && !std::filesystem::is_regular_file(path, error)) {
    section.fail("mesh", fmt::format("a mesh file ({} {}; paths start at the scene's folder)",
                                     std::filesystem::exists(path, error) ? "no file is"
                                                                          : "there is no file",
                                     path.lexically_normal().string()));
  }
  return MeshFile{path, to_mm, section.place("mesh")};
}

std::array<Attachment, 2> read_ends(const Section& section, const Scene& scene) {
  const std::string expected = "two ends [{ body = \"...\", at = [x, y, z] }, { ... }]";
  const std::vector<Section> tables = section.tables("ends", expected);
  if (tables.size() != 2) section.fail("ends", expected);
  std::array<Attachment, 2> ends;
  for (std::size_t i = 0; i < 2; ++i) {
    ends[i].body = tables[i].reference("body", "the name of a body", names_of(scene.bodies));
    ends[i].at = scene.length_to_mm * tables[i].vector("at", "a point in the frame of the body");
    tables[i].finish();
  }
  if (ends[0].body == ends[1].body) section.fail("ends", "two ends on two different bodies");
  return ends;
}

Eigen::Matrix3d read_axes(const Section& section, const std::string& key, const Scene& scene) {
  const std::string expected =
      "a rotation vector [x, y, z] or three directions [[x, y, z], [..], [..]]";
  const Value& value = section.value(key, expected);
  if (value.type == Value::Type::kArray && !value.items.empty() && value.items[0].is_number()) {
    return exp_rotation(read_rotation(section, key, scene));
  }
  const std::vector<Eigen::Vector3d> directions = section.vectors(key, expected);
  if (directions.size() != 3) section.fail(key, expected);
  Eigen::Matrix3d axes;
  for (int i = 0; i < 3; ++i) axes.col(i) = directions[static_cast<std::size_t>(i)];
  constexpr double kRounding = 1e-3;  // directions written with four digits
  if (!(axes.transpose() * axes).isIdentity(kRounding))
    section.fail(key, "three unit vectors at right angles");
  if (axes.determinant() < 0) section.fail(key, "a right-handed triad");
  return orthonormalized(axes);
}

}  // namespace condyle
