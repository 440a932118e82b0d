#include "condyle/results/unkept_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <string>

namespace condyle {
namespace {

enum SlotState { kFree, kTaken, kNamed };

struct NameSlot {
  std::atomic<int> state = kFree;
  bool unless_it_holds_bytes = false;
  std::array<char, PATH_MAX> name;
};

// A signal handler reads them: plain storage, and more than files are written at the same time. A file
// beyond them, or with a longer name, is written all the same.
std::array<NameSlot, 64> slots;

std::size_t take_slot(const std::string& name, bool unless_it_holds_bytes) {
  for (std::size_t i = 0; i < slots.size() && name.size() < PATH_MAX; ++i) {
    int free = kFree;
    if (!slots[i].state.compare_exchange_strong(free, kTaken)) continue;
    slots[i].name[name.copy(slots[i].name.data(), name.size())] = '\0';
    slots[i].unless_it_holds_bytes = unless_it_holds_bytes;
    slots[i].state = kNamed;
    return i;
  }
  return slots.size();
}

}  // namespace

UnkeptFile::UnkeptFile(const std::filesystem::path& name, Unless unless)
    : slot_(take_slot(name.string(), unless == Unless::kHoldsBytes)) {}

UnkeptFile::~UnkeptFile() {
  if (slot_ < slots.size()) slots[slot_].state = kFree;
}

void remove_unkept_files() noexcept {
  for (const NameSlot& place : slots) {
    if (place.state != kNamed) continue;
    struct stat file {};
    const bool holds_bytes = ::stat(place.name.data(), &file) == 0 && file.st_size > 0;
    if (!(place.unless_it_holds_bytes && holds_bytes)) ::unlink(place.name.data());
  }
}

}  // namespace condyle
