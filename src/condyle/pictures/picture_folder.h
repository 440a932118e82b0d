#pragma once

/// The folder that pictures and plots go into.

#include <filesystem>
#include <string>

namespace condyle {

/// Makes the folder where only its last part is missing. Throws InputError when it cannot be
/// written into, or is to be made with the name of a picture.
[[nodiscard]] std::filesystem::path make_picture_folder(const std::string& folder);

}  // namespace condyle
