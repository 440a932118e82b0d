/// All doors as one program of libFuzzer: condyle_fuzz --door=NAME OPTIONS... (tools/fuzz.sh).

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>

#include "fuzz/doors.h"

namespace {

const condyle::fuzz::Door* chosen = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view kOption = "--door=";
  for (int i = 1; i < *argc; ++i) {
    const std::string_view word = (*argv)[i];
    if (!word.starts_with(kOption)) continue;
    for (const condyle::fuzz::Door& door : condyle::fuzz::doors())
      if (door.name == word.substr(kOption.size())) chosen = &door;
  }
  if (chosen != nullptr) return 0;
  std::fputs("condyle_fuzz: expected --door= and one of\n", stderr);
  for (const condyle::fuzz::Door& door : condyle::fuzz::doors())
    std::fprintf(stderr, "  %s\n", door.name.c_str());
  std::exit(1);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > chosen->largest) return -1;
  chosen->open({data, size});
  return 0;
}
