#pragma once

/// SHA-256 of a file, as `sha256sum` prints it, and base64 (RFC 4648), both by OpenSSL's libcrypto.

#include <filesystem>
#include <string>
#include <string_view>

namespace condyle {

/// 64 hexadecimal digits. Throws InputError for a file that cannot be read.
[[nodiscard]] std::string sha256_of_file(const std::filesystem::path& file);

[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace condyle
