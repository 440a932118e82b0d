/// A door with bytes that are drawn at random: for those that take them for choices, in any build.
///
///     condyle_random_door DOOR FIRST COUNT KEPT
///
/// Input k is a function of k. KEPT holds the one under way, for when it ends the program.

#include <charconv>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <random>
#include <string>

#include "fuzz/doors.h"

namespace {

std::vector<std::uint8_t> input(const condyle::fuzz::Door& door, long k) {
  std::mt19937_64 random(static_cast<std::uint64_t>(k));
  std::vector<std::uint8_t> bytes(random() % (door.largest + 1));
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

long whole(const char* text) {
  long number = 0;
  std::from_chars(text, text + std::strlen(text), number);
  return number;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("condyle_random_door DOOR FIRST COUNT KEPT\n", stderr);
    return 1;
  }
  const condyle::fuzz::Door& door = condyle::fuzz::door(argv[1]);
  const long first = whole(argv[2]), count = whole(argv[3]);
  int finds = 0;
  for (long k = first; k < first + count; ++k) {
    const std::vector<std::uint8_t> bytes = input(door, k);
    std::ofstream(argv[4], std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
    try {
      door.open(bytes);
    } catch (const std::exception& defect) {
      ++finds;
      std::fprintf(stderr, "%s %ld: %s\n", door.name.c_str(), k, defect.what());
    }
  }
  std::printf("%s: %ld inputs, %d finds\n", door.name.c_str(), count, finds);
  return finds == 0 ? 0 : 2;
}
