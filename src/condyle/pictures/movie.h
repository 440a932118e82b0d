#pragma once

/// A movie of pictures: an animated PNG, or an MP4 (H.264) through the program ffmpeg.

#include <filesystem>
#include <string>

#include "condyle/pictures/animated_png.h"

namespace condyle {

class Movie {
 public:
  /// The ending of `path` decides: .mp4, else an animated PNG. Throws PictureError for an MP4 where
  /// ffmpeg is missing, before anything is drawn.
  Movie(std::filesystem::path path, int frames_per_second);

  void add(const Image& frame);
  /// Writes the file, whole or not at all. Throws InputError where it cannot be written,
  /// PictureError where ffmpeg refuses.
  void finish();

 private:
  void write_mp4() const;

  std::filesystem::path path_;
  int frames_per_second_;
  bool mp4_;
  AnimatedPng animated_;
  std::string stills_;  // PNG files one after the other, for ffmpeg
};

}  // namespace condyle
