#include "condyle/build_info.h"

#include <string>

#include "condyle/python/bindings.h"
#include "condyle/version.h"

namespace condyle::python {
namespace {

py::dict build_info_of_module() {
  const BuildInfo info = build_info();
  py::dict libraries;
  for (const BuiltWith& library : info.libraries) libraries[library.name.c_str()] = library.version;
  libraries["pybind11"] =
      std::to_string(PYBIND11_VERSION_MAJOR) + "." + std::to_string(PYBIND11_VERSION_MINOR);
  py::dict out;
  out["version"] = info.version;
  out["made_by"] = info.made_by;
  out["build_type"] = info.build_type;
  out["compiler"] = info.compiler;
  out["processor"] = info.processor;
  out["libraries"] = libraries;
  return out;
}

}  // namespace

void bind_build_info(py::module_& m) {
  m.attr("__version__") = CONDYLE_VERSION;
  m.def(
      "build_info", &build_info_of_module,
      "How this module was built: version, made_by (\"cmake\", \"Debian package\" or \"wheel\"),\n"
      "build_type, compiler, processor, and a dict of libraries with their versions.");
}

}  // namespace condyle::python
