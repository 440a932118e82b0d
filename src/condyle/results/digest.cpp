#include "condyle/results/digest.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "condyle/input_error.h"

namespace condyle {

std::string sha256_of_file(const std::filesystem::path& file) {
  // A result file may name whatever it likes: a device has no end.
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw InputError(file.string() + ": cannot be read, expected a file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string() + ": cannot be read");
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                        &EVP_MD_CTX_free);
  bool good = context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
  std::vector<char> piece(std::size_t{1} << 16);
  while (good && stream) {
    stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    good = EVP_DigestUpdate(context.get(), piece.data(),
                            static_cast<std::size_t>(stream.gcount())) == 1;
  }
  if (stream.bad()) throw InputError(file.string() + ": cannot be read");
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned size = 0;
  if (!good || EVP_DigestFinal_ex(context.get(), digest.data(), &size) != 1)
    throw std::runtime_error("libcrypto knows no SHA-256");
  std::string digits;
  for (unsigned i = 0; i < size; ++i) digits += fmt::format("{:02x}", digest[i]);
  return digits;
}

std::string base64(std::string_view bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');  // libcrypto ends it with a zero
  const auto* begin = reinterpret_cast<const unsigned char*>(bytes.data());
  // EVP_EncodeBlock counts in int: pieces of a multiple of 3 bytes join without padding.
  constexpr std::size_t kPiece = std::size_t{3} << 24;
  std::size_t written = 0;
  for (std::size_t i = 0; i < bytes.size(); i += kPiece) {
    const auto size = static_cast<int>(std::min(kPiece, bytes.size() - i));
    written += static_cast<std::size_t>(
        EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data() + written), begin + i, size));
  }
  text.resize(written);
  return text;
}

}  // namespace condyle
