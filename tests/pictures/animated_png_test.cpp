#include "condyle/pictures/animated_png.h"

#include <gtest/gtest.h>

#include <fstream>

#include "condyle/pictures/movie.h"
#include "condyle/pictures/png_file.h"
#include "condyle/pictures/run_program.h"
#include "support/scratch_folder.h"

namespace condyle {
namespace {

/// White, with a dark square that walks to the right.
Image frame(int step) {
  Image image = blank_image(64, 48, {255, 255, 255});
  for (int y = 20; y < 28; ++y)
    for (int x = 4 + 8 * step; x < 12 + 8 * step; ++x) image.rgb[image.offset(x, y)] = 30;
  return image;
}

AnimatedPng walk(int frames) {
  AnimatedPng movie(10);
  for (int i = 0; i < frames; ++i) movie.add(frame(i));
  return movie;
}

void write(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST(AnimatedPng, IsAPngOfItsFirstFrameForThoseWhoKnowNoBetter) {
  const auto file = test::fresh_folder("condyle_movies") / "walk.png";
  write(file, walk(5).bytes());
  const Image first = read_png(file);
  EXPECT_EQ(first.width, 64);
  EXPECT_EQ(first.rgb, frame(0).rgb);
}

TEST(AnimatedPng, SameFramesGiveTheSameBytes) { EXPECT_EQ(walk(4).bytes(), walk(4).bytes()); }

TEST(AnimatedPng, KeepsOnlyWhatChanged) {
  AnimatedPng still(10);
  for (int i = 0; i < 20; ++i) still.add(frame(0));
  EXPECT_LT(still.bytes().size(), encode_png(frame(0)).size() + 20 * 150);
}

/// Pillow puts every frame together, which checks the rectangles as well.
TEST(AnimatedPng, AnIndependentReaderFindsEveryFrame) {
  if (run_program({"/usr/bin/python3", "-c", "import PIL"}, "").exit_code != 0)
    GTEST_SKIP() << "python3 with PIL (Debian package python3-pil) is not installed";
  const auto folder = test::fresh_folder("condyle_movies");
  write(folder / "walk.png", walk(6).bytes());
  const std::string script =
      "import sys\nfrom PIL import Image\nmovie = Image.open(sys.argv[1])\n"
      "assert movie.n_frames == 6, movie.n_frames\n"
      "for i in range(6):\n"
      "    movie.seek(i)\n"
      "    still = movie.convert('RGB')\n"
      "    dark = [x for x in range(64) if still.getpixel((x, 24))[0] < 100]\n"
      "    assert dark == list(range(4 + 8 * i, 12 + 8 * i)), (i, dark)\n"
      "    assert movie.info['duration'] == (1100 if i == 5 else 100), movie.info\n";
  const ProgramResult read =
      run_program({"/usr/bin/python3", "-c", script, (folder / "walk.png").string()}, "");
  EXPECT_EQ(read.exit_code, 0) << read.messages;
}

TEST(Movie, WritesAnMp4WhereFfmpegIs) {
  const auto file = test::fresh_folder("condyle_movies") / "walk.mp4";
  if (!run_program({"ffmpeg", "-version"}, "").started) {
    EXPECT_THROW(Movie(file, 10), std::runtime_error);
    GTEST_SKIP() << "ffmpeg is not installed: that much was said";
  }
  Movie movie(file, 10);
  for (int i = 0; i < 6; ++i) movie.add(frame(i));
  movie.finish();
  EXPECT_GT(std::filesystem::file_size(file), 500u);
  const ProgramResult read = run_program(
      {"sh", "-c",
       "test \"$(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of "
       "csv=p=0 \"$1\")\" = 6",
       "sh", file.string()},
      "");
  EXPECT_EQ(read.exit_code, 0) << read.messages;
}

TEST(Movie, AnAnimatedPngNeedsNoOtherProgram) {
  const auto folder = test::fresh_folder("condyle_movies");
  Movie movie(folder / "walk.png", 10);
  movie.add(frame(0));
  movie.add(frame(1));
  movie.finish();
  EXPECT_EQ(read_png(folder / "walk.png").rgb, frame(0).rgb);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1) << "nothing else";
}

}  // namespace
}  // namespace condyle
