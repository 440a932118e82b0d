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
namespace {

/// What the assembler laid down between two of its marks.
std::string_view between(const char* begin, const char* end) {
  return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::string_view page_style() { return between(condyle_page_style_begin, condyle_page_style_end); }

std::string_view viewer_script() {
#ifdef CONDYLE_VIEWER_SCRIPT
  return between(condyle_viewer_script_begin, condyle_viewer_script_end);
#else
  return {};
#endif
}

}  // namespace condyle
