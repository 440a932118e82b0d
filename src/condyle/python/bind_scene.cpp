#include <filesystem>

#include "condyle/input_error.h"
#include "condyle/python/arguments.h"
#include "condyle/python/bindings.h"
#include "condyle/python/own_functions.h"
#include "condyle/results/output_file.h"
#include "condyle/scene_file/moved_paths.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle::python {
namespace {

using Functions = std::vector<std::pair<std::string, py::object>>;

template <typename T>
std::size_t index_of(const std::string& name, const std::vector<T>& items) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].name == name) return i;
  throw InputError("\"" + name + "\": no such element of the scene");
}

void set_laws(const py::dict& laws, KneeScene& knee) {
  for (const auto& [name, function] : laws) {
    const auto text = py::cast<std::string>(name);
    const std::string owner = "[[ligament]] \"" + text + "\": law";
    const std::size_t index = index_of(text, knee.scene.ligaments);
    knee.scene.ligaments[index].law = own_law(py::reinterpret_borrow<py::object>(function), owner);
    knee.own_function = owner;
  }
}

void set_loads(const py::dict& loads, KneeScene& knee) {
  for (const auto& [name, function] : loads) {
    const auto text = py::cast<std::string>(name);
    const std::string owner = "[[load]] \"" + text + "\": function";
    const std::size_t index = index_of(text, knee.scene.loads);
    knee.loads[index] = own_load(py::reinterpret_borrow<py::object>(function), owner);
    knee.own_function = owner;
  }
}

std::shared_ptr<KneeScene> parse(const std::string& text,
                                 const std::string& file,
                                 bool meshes_must_exist,
                                 const py::dict& laws,
                                 const py::dict& loads) {
  auto knee = std::make_shared<KneeScene>();
  knee->scene = parse_scene(text, file, meshes_must_exist);
  set_laws(laws, *knee);
  set_loads(loads, *knee);
  return knee;
}

}  // namespace

std::shared_ptr<const KneeScene> scene_of(const py::object& scene) {
  if (py::isinstance<KneeScene>(scene)) return py::cast<std::shared_ptr<KneeScene>>(scene);
  if (!py::hasattr(scene, "_parsed"))
    throw py::type_error(std::string("scene: ") + Py_TYPE(scene.ptr())->tp_name +
                         ", expected a condyle.Scene (condyle.read_scene reads one from a file)");
  return py::cast<std::shared_ptr<KneeScene>>(scene.attr("_parsed")());
}

void bind_scene(py::module_& m) {
  py::class_<KneeScene, std::shared_ptr<KneeScene>>(m, "ParsedScene",
                                                    "A scene as its reader understands it.")
      .def(py::init(&parse), py::arg("text"), py::arg("file"), py::arg("meshes_must_exist"),
           py::arg("laws"), py::arg("loads"));
  m.def(
      "scene_text",
      [](const py::object& file) {
        const std::string name = path(file, "path");
        return py::make_tuple(read_scene(name).text, name);
      },
      py::arg("path"), "The text of a scene file that can be read, and its path.");
  m.def(
      "write_scene_text",
      [](const std::string& text, const std::string& from, const py::object& file) {
        const std::string name = path(file, "path");
        check_output_file(name, ".toml");
        write_output_file(name, moved_scene_text(text, from, name));
      },
      py::arg("text"), py::arg("from_file"), py::arg("path"),
      "Write the text of a scene file; relative paths in it are told from the folder of `path`, "
      "not of `from_file`.");
}

}  // namespace condyle::python
