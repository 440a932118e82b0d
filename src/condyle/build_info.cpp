#include "condyle/build_info.h"

#include <fmt/format.h>

#include "condyle/build_facts.h"
#include "condyle/version.h"

namespace condyle {

BuildInfo build_info() {
  return {CONDYLE_VERSION,  CONDYLE_MADE_BY,   CONDYLE_BUILD_TYPE,
          CONDYLE_COMPILER, CONDYLE_PROCESSOR, {CONDYLE_BUILT_WITH}};
}

std::string build_lines(const BuildInfo& info) {
  std::string libraries;
  for (const BuiltWith& library : info.libraries)
    libraries +=
        fmt::format("{}{} {}", libraries.empty() ? "" : ", ", library.name, library.version);
  return fmt::format("build: {}, {}, {}, {}\nwith: {}", info.made_by, info.build_type,
                     info.compiler, info.processor, libraries);
}

}  // namespace condyle
