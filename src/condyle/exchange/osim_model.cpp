#include "condyle/exchange/osim_model.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <pugixml.hpp>
#include <sstream>

#include "condyle/file_ending.h"
#include "condyle/input_error.h"

namespace condyle {
namespace {

using Eigen::Vector3d;
using pugi::xml_node;

constexpr double kMillimetre = 1e3;   // per m
constexpr double kMegapascal = 1e-6;  // per Pa; N/mm²
constexpr int kFirstVersionWithFrames = 30505;
constexpr int kDeepest = 100;  // elements that hold a component: its path is made of them

class OsimReader {
 public:
  explicit OsimReader(const std::filesystem::path& file) : file_(file.string()) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw InputError(file_ + ": no such file, expected an OpenSim model (.osim)");
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (const std::size_t begin = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
        begin != std::string::npos && std::isalnum(text[begin] & 0xff) != 0)
      throw InputError(file_ + ": begins with no tag, expected an OpenSim model (XML)");
    const pugi::xml_parse_result result = document_.load_buffer(text.data(), text.size());
    if (!result) {
      const auto end = text.begin() + std::min<std::ptrdiff_t>(result.offset, std::ssize(text));
      throw InputError(fmt::format("{}:{}: {}, expected an OpenSim model (XML)", file_,
                                   1 + std::count(text.begin(), end, '\n'), result.description()));
    }
  }

  [[nodiscard]] OsimModel model() {
    const xml_node root = document_.child("OpenSimDocument");
    const xml_node model = root.child("Model");
    if (!model) throw InputError(file_ + ": holds no Model, expected an OpenSim model");
    if (root.attribute("Version").as_int() < kFirstVersionWithFrames) {
      throw InputError(fmt::format(
          "{}: OpenSimDocument Version = {}, expected {} or later (OpenSim 4 saves such files)",
          file_, root.attribute("Version").value(), kFirstVersionWithFrames));
    }
    expect_unit(model, "length_units", {"m", "meters"});
    expect_unit(model, "force_units", {"N", "newtons"});
    out_.name = model.attribute("name").value();
    for (const xml_node body : objects(model, "BodySet"))
      out_.bodies.push_back(body.attribute("name").value());
    for (const auto& found : model.select_nodes(".//PhysicalOffsetFrame")) read_frame(found.node());
    for (const auto& found : model.select_nodes(".//attached_geometry/Mesh"))
      read_bone_mesh(found.node());
    for (const auto& found : model.select_nodes(".//WrapObjectSet/objects/*"))
      read_wrap(found.node());
    for (const xml_node joint : objects(model, "JointSet")) read_joint(joint);
    for (const xml_node mesh : objects(model, "ContactGeometrySet")) read_contact_mesh(mesh);
    for (const xml_node force : objects(model, "ForceSet")) read_force(force);
    return std::move(out_);
  }

 private:
  [[nodiscard]] static pugi::xml_object_range<pugi::xml_node_iterator> objects(
      const xml_node& model, const char* set) {
    return model.child(set).child("objects").children();
  }

  [[noreturn]] void fail(const xml_node& node, const std::string& message) const {
    throw InputError(fmt::format("{}: {} \"{}\": {}", file_, node.name(),
                                 node.attribute("name").value(), message));
  }

  void expect_unit(const xml_node& model,
                   const char* key,
                   const std::vector<std::string>& known) const {
    const std::string unit = text(model, key);
    if (unit.empty() || std::find(known.begin(), known.end(), unit) != known.end()) return;
    throw InputError(fmt::format("{}: {} = {}, expected {}", file_, key, unit, known[0]));
  }

  [[nodiscard]] static std::string text(const xml_node& node, const char* key) {
    std::istringstream words(node.child_value(key));
    std::string word, all;
    while (words >> word) all += (all.empty() ? "" : " ") + word;
    return all;
  }

  [[nodiscard]] std::vector<double> numbers(const xml_node& node, const char* key) const {
    std::istringstream stream(node.child_value(key));
    std::vector<double> values;
    double value = 0;
    while (stream >> value) values.push_back(value);
    if (!stream.eof()) fail(node, fmt::format("{} = {}, expected numbers", key, text(node, key)));
    return values;
  }

  [[nodiscard]] double number(const xml_node& node, const char* key) const {
    const std::vector<double> values = numbers(node, key);
    if (values.size() != 1) {
      fail(node, node.child(key) ? fmt::format("{} = {}, expected a number", key, text(node, key))
                                 : fmt::format("has no {}", key));
    }
    return values[0];
  }
  [[nodiscard]] double number_or(const xml_node& node, const char* key, double otherwise) const {
    return node.child(key) ? number(node, key) : otherwise;
  }

  /// As OpenSim reads it: True, FALSE, 1 and 0, too.
  [[nodiscard]] bool flag_or(const xml_node& node, const char* key, bool otherwise) const {
    const std::string word = lower_case(text(node, key));
    if (word.empty()) return otherwise;
    const bool is_true = word == "true" || word == "1";
    if (!is_true && word != "false" && word != "0")
      fail(node, fmt::format("{} = {}, expected true or false", key, text(node, key)));
    return is_true;
  }

  /// Whether a force acts; before version 30509 the key was the opposite one.
  [[nodiscard]] bool applies(const xml_node& force) const {
    return flag_or(force, "appliesForce", !flag_or(force, "isDisabled", false));
  }

  [[nodiscard]] Vector3d vector_or(const xml_node& node,
                                   const char* key,
                                   const Vector3d& otherwise) const {
    if (!node.child(key)) return otherwise;
    const std::vector<double> v = numbers(node, key);
    if (v.size() != 3)
      fail(node, fmt::format("{} = {}, expected three numbers", key, text(node, key)));
    return {v[0], v[1], v[2]};
  }

  /// Angles about x, y, z, each about the axes as turned so far.
  [[nodiscard]] static Eigen::Matrix3d rotation_xyz(const Vector3d& angles) {
    return (Eigen::AngleAxisd(angles.x(), Vector3d::UnitX()) *
            Eigen::AngleAxisd(angles.y(), Vector3d::UnitY()) *
            Eigen::AngleAxisd(angles.z(), Vector3d::UnitZ()))
        .toRotationMatrix();
  }

  [[nodiscard]] RigidTransform pose(const xml_node& node, const char* shift) const {
    return {rotation_xyz(vector_or(node, "orientation", Vector3d::Zero())),
            kMillimetre * vector_or(node, shift, Vector3d::Zero())};
  }

  /// Where a component stands: the names of those that hold it. A set of the model is called by its
  /// type, whatever its name.
  [[nodiscard]] std::string path_of(const xml_node& node) const {
    std::string path;
    int depth = 0;
    for (xml_node at = node; at && std::strcmp(at.name(), "Model") != 0; at = at.parent()) {
      if (++depth > kDeepest)
        throw InputError(fmt::format(
            "{}: components lie more than {} deep within each other, expected an OpenSim model",
            file_, kDeepest));
      std::string name = at.attribute("name").value();
      if (std::strcmp(at.parent().name(), "Model") == 0 && at.child("objects")) {
        name = at.name();
        for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      }
      if (!name.empty()) path.insert(0, "/" + name);
    }
    return path;
  }

  /// The path that a socket holds, in the spelling of OpenSim 4 or of its development versions.
  [[nodiscard]] static std::string socket(const xml_node& node, const std::string& name) {
    for (const std::string& key : {"socket_" + name, "socket_" + name + "_connectee_name",
                                   "connector_" + name + "_connectee_name"})
      if (node.child(key.c_str())) return text(node, key.c_str());
    for (const xml_node connector : node.child("connectors").children())
      if (connector.attribute("name").value() == name) return text(connector, "connectee_name");
    return "";
  }

  void read_frame(const xml_node& frame) {
    out_.frames.push_back({frame.attribute("name").value(), path_of(frame), socket(frame, "parent"),
                           pose(frame, "translation")});
  }

  void read_bone_mesh(const xml_node& node) {
    OsimMesh mesh;
    mesh.name = node.attribute("name").value();
    mesh.path = path_of(node);
    mesh.frame = socket(node, "frame");
    if (mesh.frame.empty()) mesh.frame = "..";
    mesh.file = text(node, "mesh_file");
    mesh.scale = vector_or(node, "scale_factors", Vector3d::Ones());
    out_.bone_meshes.push_back(mesh);
  }

  /// The frame that a wrap object is fixed to holds it.
  void read_wrap(const xml_node& node) {
    OsimWrap wrap;
    wrap.type = node.name();
    wrap.name = node.attribute("name").value();
    wrap.frame = path_of(node.parent().parent().parent());
    wrap.X_frame = {rotation_xyz(vector_or(node, "xyz_body_rotation", Vector3d::Zero())),
                    kMillimetre * vector_or(node, "translation", Vector3d::Zero())};
    wrap.quadrant = text(node, "quadrant");
    wrap.active = flag_or(node, "active", true);
    if (wrap.type == "WrapEllipsoid")
      wrap.sizes = vector_or(node, "dimensions", Vector3d::Zero());
    else if (wrap.type == "WrapTorus")
      wrap.sizes = {number(node, "inner_radius"), number(node, "outer_radius"), 0};
    else if (wrap.type == "WrapSphere" || wrap.type == "WrapCylinder")
      wrap.sizes.x() = number(node, "radius");
    wrap.sizes *= kMillimetre;
    out_.wraps.push_back(wrap);
  }

  /// Before version 30507 they stood in a set of their own.
  [[nodiscard]] std::map<std::string, double> default_coordinates(const xml_node& joint) const {
    std::map<std::string, double> values;
    for (const xml_node set :
         {joint.child("coordinates"), joint.child("CoordinateSet").child("objects")})
      for (const xml_node c : set.children())
        values[c.attribute("name").value()] = number_or(c, "default_value", 0);
    return values;
  }

  void read_joint(const xml_node& node) {
    OsimJoint joint;
    joint.type = node.name();
    joint.name = node.attribute("name").value();
    joint.path = path_of(node);
    joint.parent = socket(node, "parent_frame");
    joint.child = socket(node, "child_frame");
    const std::map<std::string, double> coordinates = default_coordinates(node);
    for (const xml_node axis : node.child("SpatialTransform").children("TransformAxis")) {
      const std::string name = axis.attribute("name").value();
      const std::size_t index = name.empty() ? 3 : static_cast<std::size_t>(name.back() - '1');
      if (index > 2) fail(axis, "expected rotation1 to 3 or translation1 to 3");
      const bool turns = name.rfind("rotation", 0) == 0;
      OsimAxis& out = turns ? joint.rotations[index] : joint.translations[index];
      out.axis = vector_or(axis, "axis", Vector3d::Zero());
      const auto coordinate = coordinates.find(text(axis, "coordinates"));
      const std::optional<double> value =
          value_of(axis, coordinate == coordinates.end() ? 0 : coordinate->second);
      out.value = (turns ? 1 : kMillimetre) * value.value_or(0);
      if (out.axis.isZero()) continue;
      if (!value)
        out.unread = function_kind(axis);
      else if (coordinate == coordinates.end() && !axis.child("Constant") &&
               !text(axis, "coordinates").empty())
        out.unread = fmt::format("coordinate \"{}\" without default", text(axis, "coordinates"));
    }
    out_.joints.push_back(joint);
  }

  /// Of the child that is neither its coordinates nor its axis; empty where there is none.
  [[nodiscard]] static std::string function_kind(const xml_node& axis) {
    for (const xml_node child : axis.children()) {
      std::string kind = child.name();
      if (!kind.empty() && kind != "coordinates" && kind != "axis") return kind;
    }
    return "";
  }

  /// The function that `holder` holds, at x. It serves a first estimate of the pose only, so a
  /// spline counts as straight between its points. Nothing for a function of another kind.
  [[nodiscard]] std::optional<double> value_of(xml_node holder, double x) const {
    double factor = 1;
    while (const xml_node f = holder.child("MultiplierFunction")) {
      factor *= number_or(f, "scale", 1);
      holder = f.child("function");
    }
    if (const xml_node f = holder.child("Constant")) return factor * number_or(f, "value", 0);
    for (const char* kind : {"LinearFunction", "PolynomialFunction"}) {
      const xml_node f = holder.child(kind);
      if (!f) continue;
      std::vector<double> coefficients = numbers(f, "coefficients");
      if (coefficients.empty()) coefficients = {1, 0};  // OpenSim's own
      double y = 0;                                     // the greatest power comes first
      for (const double c : coefficients) y = y * x + c;
      return factor * y;
    }
    for (const char* kind :
         {"SimmSpline", "NaturalCubicSpline", "GCVSpline", "PiecewiseLinearFunction"}) {
      if (const xml_node f = holder.child(kind))
        if (const auto y = between(numbers(f, "x"), numbers(f, "y"), x)) return factor * *y;
    }
    return std::nullopt;
  }

  /// Nothing where the points are none of a function.
  [[nodiscard]] static std::optional<double> between(const std::vector<double>& xs,
                                                     const std::vector<double>& ys,
                                                     double x) {
    if (xs.empty() || xs.size() != ys.size()) return std::nullopt;
    for (std::size_t i = 1; i < xs.size(); ++i)
      if (!(xs[i] > xs[i - 1])) return std::nullopt;
    for (std::size_t i = 1; i < xs.size(); ++i) {
      if (x > xs[i] && i + 1 < xs.size()) continue;
      return ys[i - 1] + (ys[i] - ys[i - 1]) * (x - xs[i - 1]) / (xs[i] - xs[i - 1]);
    }
    return ys[0];
  }

  void read_contact_mesh(const xml_node& node) {
    if (std::strcmp(node.name(), "Smith2018ContactMesh") != 0) return;
    OsimMesh mesh;
    mesh.name = node.attribute("name").value();
    mesh.path = path_of(node);
    mesh.frame = socket(node, "frame");
    mesh.file = text(node, "mesh_file");
    mesh.scale = vector_or(node, "scale_factors", Vector3d::Ones());
    mesh.X_frame = pose(node, "location");
    mesh.modulus = kMegapascal * number_or(node, "elastic_modulus", 0);
    mesh.poisson = number_or(node, "poissons_ratio", 0.5);
    mesh.layer = kMillimetre * number_or(node, "thickness", 0);
    if (mesh.file.empty()) fail(node, "has no mesh_file");
    out_.contact_meshes.push_back(mesh);
  }

  void read_force(const xml_node& node) {
    const std::string type = node.name();
    if (type == "Blankevoort1991Ligament") {
      read_ligament(node);
    } else if (type == "Smith2018ArticularContactForce") {
      out_.contacts.push_back({node.attribute("name").value(), socket(node, "target_mesh"),
                               socket(node, "casting_mesh"),
                               text(node, "elastic_foundation_formulation") == "nonlinear",
                               applies(node)});
    } else {
      ++out_.other_forces[type];
    }
  }

  void read_ligament(const xml_node& node) {
    OsimLigament ligament;
    ligament.name = node.attribute("name").value();
    ligament.applies = applies(node);
    ligament.stiffness = number(node, "linear_stiffness");
    ligament.transition_strain = number_or(node, "transition_strain", ligament.transition_strain);
    ligament.slack_length = kMillimetre * number(node, "slack_length");
    const xml_node path = node.child("GeometryPath");
    for (const xml_node wrap : path.child("PathWrapSet").child("objects").children())
      ligament.wraps.push_back(text(wrap, "wrap_object"));
    for (const xml_node point : path.child("PathPointSet").child("objects").children()) {
      if (!point.child("location")) fail(point, "has no location");
      ligament.points.push_back({point.name(), path_of(point), socket(point, "parent_frame"),
                                 kMillimetre * vector_or(point, "location", Vector3d::Zero())});
    }
    if (ligament.points.size() < 2) fail(node, "has fewer than two points in its PathPointSet");
    out_.ligaments.push_back(ligament);
  }

  std::string file_;
  pugi::xml_document document_;
  OsimModel out_;
};

}  // namespace

OsimModel read_osim(const std::filesystem::path& file) { return OsimReader(file).model(); }

}  // namespace condyle
