/// Chunks of a study under way. The first byte says whether the file gets the right head, and whether the
/// records' checksums are set right.

#include <cstring>
#include <stdexcept>

#include "condyle/results/run_identity.h"
#include "condyle/results/study_chunk_file.h"
#include "condyle/results/study_identity.h"
#include "fuzz/door_list.h"
#include "fuzz/memory_file.h"
#include "fuzz/refusal.h"

namespace condyle::fuzz {
namespace {

constexpr ChunkLayout kLayout = {
    .samples = 130, .poses = 2, .outputs = 1, .single_precision = true};

/// As far as records of the study's size follow each other.
void set_checksums(std::string& records) {
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  for (std::size_t at = 0; at + kWord <= records.size();) {
    std::uint64_t chunk = 0;
    std::memcpy(&chunk, records.data() + at, kWord);
    if (chunk >= kLayout.chunks()) return;
    const std::size_t size = kLayout.record_bytes(chunk);
    if (at + size > records.size()) return;
    const std::uint64_t head[3] = {chunk, kLayout.samples_in(chunk), kLayout.payload_bytes(chunk)};
    std::memcpy(records.data() + at, head, sizeof head);
    const std::uint64_t sum = hash_bytes(std::string_view(records).substr(at, size - kWord));
    std::memcpy(records.data() + at + size - kWord, &sum, kWord);
    at += size;
  }
}

}  // namespace

void open_study_chunks(Bytes bytes) {
  const StudyIdentity identity = {{"study", 1}, {"seed", 2}, {"scene knee.toml", 3}};
  const std::uint8_t how = bytes.empty() ? 0 : bytes[0];
  std::string records = text_of(bytes.empty() ? bytes : bytes.subspan(1));
  if (how % 2 == 0) set_checksums(records);
  const MemoryFile file(how % 4 < 2 ? head_of(identity) + records : records);
  taken([&] {
    find_chunks(file.path(), 0, kLayout, identity, [&](std::uint64_t chunk, std::uint64_t at) {
      const auto read = chunk_of(read_record(file.path(), at, chunk, kLayout), kLayout);
      if (!read || read->index != chunk)
        throw std::logic_error("a chunk that was found is not there");
    });
  });
}

}  // namespace condyle::fuzz
