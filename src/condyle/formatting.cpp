/// The compiled part of fmt, once: all other files of the mechanics parse its interface only, and who
/// links the mechanics needs no library for words.

#define FMT_HEADER_ONLY
#include <fmt/core.h>

namespace condyle {
namespace {

/// Keeps what fmt::format calls, and all that it calls.
[[gnu::used]] std::string (*const kFormat)(fmt::string_view, fmt::format_args) = &fmt::vformat;

}  // namespace
}  // namespace condyle
