#include "condyle/pictures/animated_png.h"

#include <zlib.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "condyle/pictures/png_file.h"

namespace condyle {
namespace {

constexpr std::size_t kSignature = 8, kHead = 8, kCheck = 4;  // bytes: of the file, of a chunk

void add_number(std::string& bytes, std::uint32_t value, int size = 4) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8)
    bytes += static_cast<char>((value >> shift) & 0xffU);
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = (value << 8) | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

void add_chunk(std::string& file, const std::string& kind, const std::string& data) {
  add_number(file, static_cast<std::uint32_t>(data.size()));
  const std::string checked = kind + data;
  file += checked;
  add_number(file,
             static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(checked.data()),
                                              static_cast<uInt>(checked.size()))));
}

/// The compressed rows of a PNG file: what its IDAT chunks hold together.
std::string rows_of(const std::string& png) {
  std::string rows;
  for (std::size_t at = kSignature; at + kHead + kCheck <= png.size();) {
    const std::size_t size = number_at(png, at);
    if (png.compare(at + 4, 4, "IDAT") == 0) rows.append(png, at + kHead, size);
    at += kHead + size + kCheck;
  }
  return rows;
}

struct Box {
  int left, top, right, bottom;
};

/// The least rectangle outside of which two images are equal; one pixel where they are equal.
Box changed(const Image& a, const Image& b) {
  Box box{a.width, a.height, 0, 0};
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (a.at(x, y) == b.at(x, y)) continue;
      box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x + 1),
             std::max(box.bottom, y + 1)};
    }
  }
  return box.right > 0 ? box : Box{0, 0, 1, 1};
}

Image cut(const Image& image, const Box& box) {
  Image part{box.right - box.left, box.bottom - box.top, {}};
  for (int y = box.top; y < box.bottom; ++y) {
    const auto row = image.rgb.begin() + static_cast<std::ptrdiff_t>(image.offset(box.left, y));
    part.rgb.insert(part.rgb.end(), row, row + 3 * part.width);
  }
  return part;
}

}  // namespace

AnimatedPng::AnimatedPng(int frames_per_second, double hold)
    : frames_per_second_(frames_per_second), hold_(hold) {}

void AnimatedPng::add(const Image& frame) {
  assert(frames_.empty() || (frame.width == last_.width && frame.height == last_.height));
  const Box box = frames_.empty() ? Box{0, 0, frame.width, frame.height} : changed(last_, frame);
  const Image part = cut(frame, box);
  frames_.push_back({box.left, box.top, part.width, part.height, rows_of(encode_png(part))});
  last_ = frame;
}

std::string AnimatedPng::bytes() const {
  assert(!frames_.empty());
  // Signature, IHDR and sRGB as libpng writes them for a picture of this size.
  const std::string still = encode_png(last_);
  std::string file = still.substr(0, still.find("IDAT") - 4);
  std::string control;
  add_number(control, static_cast<std::uint32_t>(frames_.size()));
  add_number(control, 0);  // plays for ever
  add_chunk(file, "acTL", control);
  std::uint32_t sequence = 0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    const Frame& frame = frames_[i];
    std::string head;
    add_number(head, sequence++);
    for (const int size : {frame.width, frame.height, frame.left, frame.top})
      add_number(head, static_cast<std::uint32_t>(size));
    const bool last = i + 1 == frames_.size() && frames_.size() > 1;
    const double seconds = 1.0 / frames_per_second_ + (last ? hold_ : 0);
    add_number(head, static_cast<std::uint32_t>(std::lround(1000 * seconds)), 2);
    add_number(head, 1000, 2);
    head += std::string(2, '\0');  // the frame stays; it replaces what was there
    add_chunk(file, "fcTL", head);
    if (i == 0) {
      add_chunk(file, "IDAT", frame.data);
      continue;
    }
    std::string numbered;
    add_number(numbered, sequence++);
    add_chunk(file, "fdAT", numbered + frame.data);
  }
  add_chunk(file, "IEND", "");
  return file;
}

}  // namespace condyle
