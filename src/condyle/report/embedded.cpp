#include "condyle/report/embedded.h"

// The assembler copies the files in; CMake says where they are.
#define CONDYLE_EMBED(symbol, file)        \
  asm(".pushsection .rodata\n"             \
      ".globl " #symbol "_begin\n" #symbol \
      "_begin:\n"                          \
      ".incbin \"" file                    \
      "\"\n"                               \
      ".globl " #symbol "_end\n" #symbol   \
      "_end:\n.byte 0\n"                   \
      ".popsection\n");                    \
  extern "C" const char symbol##_begin[], symbol##_end[]

CONDYLE_EMBED(condyle_page_style, CONDYLE_PAGE_STYLE);
#ifdef CONDYLE_VIEWER_SCRIPT
CONDYLE_EMBED(condyle_viewer_script, CONDYLE_VIEWER_SCRIPT);
#endif

namespace condyle {

std::string_view page_style() {
  return {condyle_page_style_begin,
          static_cast<std::size_t>(condyle_page_style_end - condyle_page_style_begin)};
}

std::string_view viewer_script() {
#ifdef CONDYLE_VIEWER_SCRIPT
  return {condyle_viewer_script_begin,
          static_cast<std::size_t>(condyle_viewer_script_end - condyle_viewer_script_begin)};
#else
  return {};
#endif
}

}  // namespace condyle
