#include "condyle/mesh_files/mesh_bytes.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "condyle/input_error.h"

namespace condyle {

MeshBytes::MeshBytes(std::filesystem::path file) : file_(std::move(file)) {
  std::error_code error;
  if (!std::filesystem::exists(file_, error)) fail("no such file, expected a mesh");
  if (!std::filesystem::is_regular_file(file_, error))
    fail("expected a mesh file, found something else");
  const auto size = std::filesystem::file_size(file_, error);
  std::ifstream stream(file_, std::ios::binary);
  if (error || !stream) fail("mesh file cannot be read");
  if (size == 0) fail("mesh file is empty");
  size_ = static_cast<std::size_t>(size);
  bytes_ = std::make_unique_for_overwrite<char[]>(size_);
  if (!stream.read(bytes_.get(), static_cast<std::streamsize>(size_)))
    fail("mesh file cannot be read");
}

MeshBytes::MeshBytes(std::filesystem::path file, std::string_view content)
    : file_(std::move(file)),
      bytes_(std::make_unique_for_overwrite<char[]>(content.size())),
      size_(content.size()) {
  std::copy(content.begin(), content.end(), bytes_.get());
}

void MeshBytes::fail(std::string_view what) const {
  throw InputError(fmt::format("{}: {}", file_.lexically_normal().string(), what));
}

std::string quotable(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::string result(text.substr(0, kLongest));
  std::replace_if(
      result.begin(), result.end(), [](unsigned char c) { return c < 32 || c > 126; }, '?');
  if (text.size() > kLongest) result += "...";
  return result;
}

}  // namespace condyle
