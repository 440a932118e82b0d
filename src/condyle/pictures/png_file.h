#pragma once

/// PNG files through libpng. The same image gives the same bytes: no time stamp is written.

#include <filesystem>
#include <string>

#include "condyle/pictures/image.h"

namespace condyle {

/// The bytes of a PNG file.
[[nodiscard]] std::string encode_png(const Image& image);

/// Writes beside `path` first and renames: never a half-written picture. Throws InputError when the
/// folder does not exist or the disk is full.
void write_png(const std::filesystem::path& path, const Image& image);

/// Reads an 8-bit RGB picture back, for tests and for comparing. Throws InputError.
[[nodiscard]] Image read_png(const std::filesystem::path& path);

}  // namespace condyle
