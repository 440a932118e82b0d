/// Every file of tests/fuzz through its door: small ones that whoever fuzzes begins with, and what fuzzing
/// found (tools/fuzz.sh). What leaves a door is a defect.

#include "fuzz/doors.h"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <string>

#include "condyle/input_error.h"
#include "condyle/results/hdf5_file.h"
#include "condyle/scene_file/read_scene.h"

namespace condyle::fuzz {

/// A test is named after its door, not after the bytes of it.
void PrintTo(const Door& door, std::ostream* out) { *out << door.name; }

}  // namespace condyle::fuzz

namespace condyle {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(CONDYLE_SOURCE_DIR) / "tests/fuzz";

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::uint8_t> bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

class FuzzDoor : public testing::TestWithParam<fuzz::Door> {};

TEST_P(FuzzDoor, TakesOrRefusesEveryFileOfItsFolder) {
  const fuzz::Door& door = GetParam();
  const std::vector<fs::path> files = files_in(kFolder / door.name);
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) EXPECT_NO_THROW(door.open(bytes_of(file))) << file;
}

/// Cut and with a byte turned over at ten places.
TEST_P(FuzzDoor, TakesOrRefusesDamagedFiles) {
  const fuzz::Door& door = GetParam();
  for (const fs::path& file : files_in(kFolder / door.name)) {
    const std::vector<std::uint8_t> whole = bytes_of(file);
    const std::size_t step = whole.size() / 10 + 1;
    for (std::size_t at = 0; at < whole.size(); at += step) {
      std::vector<std::uint8_t> damaged = whole;
      damaged[at] ^= 0x15;
      EXPECT_NO_THROW(door.open(damaged)) << file << " turned at " << at;
      damaged.assign(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(at));
      EXPECT_NO_THROW(door.open(damaged)) << file << " cut at " << at;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Doors, FuzzDoor, testing::ValuesIn(fuzz::doors()), [](const auto& one) {
  return one.param.name;
});

/// The results of tests/fuzz/whole_results are whole.
TEST(FuzzResults, AreTakenAsTheyAre) {
  for (const fs::path& file : files_in(kFolder / "whole_results"))
    EXPECT_NO_THROW(fuzz::door("run").open(bytes_of(file))) << file;
}

/// Trees of keys that are deeper than the stack.
TEST(FuzzScene, RefusesKeysOfManyParts) {
  std::string key = "a";
  for (int i = 0; i < 200000; ++i) key += ".a";
  for (const std::string& text : {key + " = 1\n", "[" + key + "]\n", "x = { " + key + " = 1 }\n"})
    EXPECT_THROW((void)parse_scene(text, "deep.toml"), InputError);
  EXPECT_THROW((void)parse_scene("title = \"" + std::string(1000, '.') + "\"\n", "dots.toml"),
               InputError);  // for want of all else
}

/// A dataset may say that it is larger than any memory, of a file of some kilobytes.
TEST(FuzzResults, HoldNoMoreThanTheFile) {
  const fs::path file = fs::path(testing::TempDir()) / "condyle_fuzz_large.h5";
  const hsize_t rows = hsize_t{1} << 40, piece = 64;
  {
    const hid_t made = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(1, &rows, nullptr), how = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(how, 1, &piece);
    for (const char* name : {"numbers", "texts"}) {
      const hid_t type = H5Tcopy(name[0] == 'n' ? H5T_IEEE_F64LE : H5T_C_S1);
      if (name[0] == 't') H5Tset_size(type, H5T_VARIABLE);
      H5Dclose(H5Dcreate2(made, name, type, space, H5P_DEFAULT, how, H5P_DEFAULT));
      H5Tclose(type);
    }
    H5Pclose(how);
    H5Sclose(space);
    H5Fclose(made);
  }
  const Hdf5Reader reader(file);
  EXPECT_THROW((void)reader.root().read("numbers"), InputError);
  EXPECT_THROW((void)reader.root().read_texts("texts"), InputError);
  fs::remove(file);
}

}  // namespace
}  // namespace condyle
