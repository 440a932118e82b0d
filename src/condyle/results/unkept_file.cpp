#include "condyle/results/unkept_file.h"

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
  std::array<char, PATH_MAX> name;
};

// A signal handler reads them: plain storage, and more than files are written at the same time. A file
// beyond them, or with a longer name, is written all the same.
std::array<NameSlot, 8> slots;

std::size_t take_slot(const std::string& name) {
  for (std::size_t i = 0; i < slots.size() && name.size() < PATH_MAX; ++i) {
    int free = kFree;
    if (!slots[i].state.compare_exchange_strong(free, kTaken)) continue;
    slots[i].name[name.copy(slots[i].name.data(), name.size())] = '\0';
    slots[i].state = kNamed;
    return i;
  }
  return slots.size();
}

}  // namespace

UnkeptFile::UnkeptFile(const std::filesystem::path& name) : slot_(take_slot(name.string())) {}

UnkeptFile::~UnkeptFile() {
  if (slot_ < slots.size()) slots[slot_].state = kFree;
}

void remove_unkept_files() noexcept {
  for (const NameSlot& place : slots)
    if (place.state == kNamed) ::unlink(place.name.data());
}

}  // namespace condyle
