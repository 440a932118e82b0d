#pragma once

/// Where the phantom that serves `condyle new` as a template stands.

#include <filesystem>

namespace condyle {

/// data/phantom/knee.toml beside the program (build/condyle), where `cmake --install` puts it, or in the
/// sources that the program was built from. Throws InputError where it and its meshes are in none of them.
[[nodiscard]] std::filesystem::path default_template();

}  // namespace condyle
