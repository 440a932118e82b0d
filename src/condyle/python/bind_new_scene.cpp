#include <optional>
#include <string>
#include <vector>

#include "condyle/anatomy/knee_from_meshes.h"
#include "condyle/anatomy/new_scene_text.h"
#include "condyle/input_error.h"
#include "condyle/python/arguments.h"
#include "condyle/python/bindings.h"
#include "condyle/python/interrupts.h"

namespace condyle::python {
namespace {

/// One of some words, or None.
template <typename T>
std::optional<T> word_or_none(const py::object& value,
                              const char* argument,
                              const std::vector<std::pair<const char*, T>>& words) {
  if (value.is_none()) return std::nullopt;
  std::string expected;
  for (const auto& [word, meaning] : words) {
    if (py::isinstance<py::str>(value) && py::cast<std::string>(value) == word) return meaning;
    expected.append("\"").append(word).append("\", ");
  }
  throw InputError(std::string(argument) + " = " + py::cast<std::string>(py::repr(value)) +
                   ", expected " + expected + "or None");
}

NewKneeFiles files_of(const py::object& femur,
                      const py::object& tibia,
                      const py::object& template_scene,
                      const py::object& cartilage) {
  NewKneeFiles files{path(femur, "femur"), path(tibia, "tibia"), {}, {}};
  files.template_scene = path(template_scene, "template");
  if (py::isinstance<py::str>(cartilage) || !py::isinstance<py::iterable>(cartilage))
    throw py::type_error("cartilage: expected the paths of two meshes, or three");
  for (const py::handle& file : cartilage) files.cartilage.emplace_back(path(file, "cartilage"));
  const std::size_t count = files.cartilage.size();
  if (count == 1 || count > 3)
    throw InputError("cartilage: " + std::to_string(count) +
                     " paths, expected two: femoral and tibial, or three: the tibial ones apart");
  return files;
}

py::tuple new_scene_of(const py::object& femur,
                       const py::object& tibia,
                       const py::object& template_scene,
                       const py::object& cartilage,
                       const py::object& side,
                       const py::object& units,
                       const py::object& folder) {
  const NewKneeFiles files = files_of(femur, tibia, template_scene, cartilage);
  RecogniseOptions options;
  options.to_mm = word_or_none<double>(units, "units", {{"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}});
  options.side = word_or_none<Side>(side, "side", {{"right", Side::kRight}, {"left", Side::kLeft}});
  const auto file = std::filesystem::path(path(folder, "folder")) / "<new>";
  std::string text;
  run_interruptibly([&](const std::function<bool()>&) {
    text = new_scene_text(knee_from_meshes(files, options), file);
  });
  return py::make_tuple(text, file.string());
}

}  // namespace

void bind_new_scene(py::module_& m) {
  m.def("new_scene_text", &new_scene_of, py::arg("femur"), py::arg("tibia"), py::arg("template"),
        py::arg("cartilage"), py::arg("side"), py::arg("units"), py::arg("folder"),
        "The text of condyle.new_scene, and the file that its paths are told from.");
}

}  // namespace condyle::python
