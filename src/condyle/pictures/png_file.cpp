#include "condyle/pictures/png_file.h"

#include <png.h>

#include <cstring>
#include <string>

#include "condyle/input_error.h"
#include "condyle/pictures/picture_error.h"
#include "condyle/results/output_file.h"

namespace condyle {
namespace {

// Mostly white pages: a low level packs nearly as well as the highest and several times faster.
constexpr int kCompression = 3;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what);
}

[[noreturn]] void on_png_error(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}
void on_png_warning(png_structp, png_const_charp) {}
void keep(png_structp png, png_bytep data, png_size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(data), size);
}

/// libpng leaves by longjmp, so nothing with a destructor lives in here.
bool encode(png_structp png, png_infop info, std::string& bytes, const Image& image) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_write_fn(png, &bytes, keep, nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width),
               static_cast<png_uint_32>(image.height), 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_set_compression_level(png, kCompression);
  png_set_filter(png, 0, PNG_FILTER_SUB);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) png_write_row(png, image.rgb.data() + image.offset(0, y));
  png_write_end(png, info);
  return true;
}

}  // namespace

std::string encode_png(const Image& image) {
  std::string message = "no memory", bytes;
  png_structp png =
      png_create_write_struct(PNG_LIBPNG_VER_STRING, &message, on_png_error, on_png_warning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  const bool done = info && encode(png, info, bytes, image);
  png_destroy_write_struct(&png, &info);
  if (!done) throw PictureError("cannot encode a picture: " + message);
  return bytes;
}

void write_png(const std::filesystem::path& path, const Image& image) {
  write_output_file(path, encode_png(image));
}

Image read_png(const std::filesystem::path& path) {
  png_image header;
  std::memset(&header, 0, sizeof header);
  header.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&header, path.c_str()))
    fail(path, std::string("cannot read: ") + header.message);
  header.format = PNG_FORMAT_RGB;
  Image image{static_cast<int>(header.width), static_cast<int>(header.height), {}};
  image.rgb.resize(PNG_IMAGE_SIZE(header));
  if (!png_image_finish_read(&header, nullptr, image.rgb.data(), 0, nullptr)) {
    fail(path, std::string("cannot read: ") + header.message);
  }
  return image;
}

}  // namespace condyle
