/// The door CONDYLE_DOOR as libFuzzer calls it.

#include "fuzz/doors.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const condyle::fuzz::Door& door = condyle::fuzz::door(CONDYLE_DOOR);
  if (size > door.largest) return -1;
  door.open({data, size});
  return 0;
}
