#include "condyle/pictures/gl_library.h"

#include <dlfcn.h>

#include "condyle/pictures/picture_error.h"

namespace condyle {
namespace {

void* open_library() {
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"})
    if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
  throw PictureError(std::string("OSMesa cannot be opened: ") + dlerror());
}

void* find(void* library, const char* name) {
  if (void* function = dlsym(library, name)) return function;
  throw PictureError(std::string("OSMesa has no ") + name);
}

}  // namespace

// NOLINTNEXTLINE(bugprone-macro-parentheses) a name is declared
#define CONDYLE_DEFINE(function) decltype(&::function) function = nullptr;
CONDYLE_GL_FUNCTIONS(CONDYLE_DEFINE)
#undef CONDYLE_DEFINE

void open_gl() {
  static void* const library = open_library();
#define CONDYLE_FIND(function) \
  function = reinterpret_cast<decltype(&::function)>(find(library, #function));
  CONDYLE_GL_FUNCTIONS(CONDYLE_FIND)
#undef CONDYLE_FIND
}

}  // namespace condyle
