#include "condyle/input_error.h"
#include "condyle/python/bindings.h"

namespace condyle::python {

void bind_errors(py::module_& m) {
  py::register_exception<InputError>(m, "InputError", PyExc_ValueError);
  m.attr("InputError").attr("__doc__") =
      "Bad input: a scene, a mesh, a run or an argument that cannot be used.\n\n"
      "One line with the file and its line where there is one, the key or argument, its value and "
      "what was expected:\n"
      "the line that the program `condyle` prints. A ValueError. A pose that is not found is none: "
      "it has a status.";
}

namespace {

PyObject* refuse_new(PyTypeObject* type, PyObject*, PyObject*) {
  PyErr_Format(PyExc_TypeError,
               "%s is not made by calling it, expected a function that returns one", type->tp_name);
  return nullptr;
}

}  // namespace

void only_returned(const py::handle& type) {
  reinterpret_cast<PyTypeObject*>(type.ptr())->tp_new = &refuse_new;
}

OnProgress progress_of(const py::object& progress) {
  if (progress.is_none()) return {};
  if (PyCallable_Check(progress.ptr()) == 0)
    throw py::type_error("progress: expected a function of (done, total), or None");
  return [progress](int done, int total) {
    const py::gil_scoped_acquire lock;
    progress(done, total);
  };
}

}  // namespace condyle::python
