#include "condyle/pictures/png_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "condyle/input_error.h"
#include "support/scratch_folder.h"
#include "support/small_files.h"

namespace condyle {
namespace {

TEST(PngFile, ComesBackAsItWasWritten) {
  Image image = blank_image(37, 11, {1, 2, 3});
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    image.rgb[i] = static_cast<std::uint8_t>(31 * i);
  const auto file = test::fresh_folder("condyle_png") / "picture.png";
  write_png(file, image);
  const Image back = read_png(file);
  EXPECT_EQ(back.width, 37);
  EXPECT_EQ(back.height, 11);
  EXPECT_EQ(back.rgb, image.rgb);
}

TEST(PngFile, AFolderThatDoesNotExistIsNamed) {
  try {
    write_png("no/such/folder/picture.png", blank_image(4, 4, {}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no/such/folder/picture.png"), std::string::npos);
  }
}

TEST(PngFile, AFullDiskLeavesNothingBehind) {
  const auto folder = test::fresh_folder("condyle_png");
  const test::FilesUpTo small(100);
  EXPECT_THROW(write_png(folder / "picture.png", blank_image(400, 400, {9, 9, 9})), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(PngFile, WhatIsNoPictureIsRefused) {
  const auto file = test::fresh_folder("condyle_png") / "text.png";
  std::ofstream(file) << "not a picture";
  EXPECT_THROW((void)read_png(file), InputError);
}

}  // namespace
}  // namespace condyle
