#include "condyle/pictures/movie.h"

#include <utility>

#include "condyle/file_ending.h"
#include "condyle/pictures/picture_error.h"
#include "condyle/pictures/png_file.h"
#include "condyle/pictures/run_program.h"
#include "condyle/results/output_file.h"

namespace condyle {

Movie::Movie(std::filesystem::path path, int frames_per_second)
    : path_(std::move(path)),
      frames_per_second_(frames_per_second),
      mp4_(file_ending(path_) == ".mp4"),
      animated_(frames_per_second) {
  if (mp4_)
    expect_started(run_program({"ffmpeg", "-version"}, ""),
                   path_.string() +
                       ": ffmpeg is not installed: an MP4 needs it (Debian package ffmpeg); "
                       "an animated PNG needs nothing");
}

void Movie::add(const Image& frame) {
  if (mp4_)
    stills_ += encode_png(frame);
  else
    animated_.add(frame);
}

void Movie::finish() {
  if (mp4_)
    write_mp4();
  else
    write_output_file(path_, animated_.bytes());
}

void Movie::write_mp4() const {
  // By the name of its standard output, which is a file: the index of an MP4 is put before its pictures.
  const ProgramResult result =
      run_program({"ffmpeg", "-y", "-loglevel", "error", "-f", "image2pipe", "-framerate",
                   std::to_string(frames_per_second_), "-c:v", "png", "-i", "-",
                   // H.264 wants even sides; yuv420p is what players know.
                   "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-c:v", "libx264", "-crf",
                   "18", "-pix_fmt", "yuv420p", "-fflags", "+bitexact", "-flags:v", "+bitexact",
                   "-movflags", "+faststart", "-f", "mp4", "/dev/stdout"},
                  stills_);
  if (result.exit_code != 0 || result.output.empty())
    throw PictureError(path_.string() + ": ffmpeg did not write it: " + result.messages);
  write_output_file(path_, result.output);
}

}  // namespace condyle
