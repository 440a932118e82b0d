#pragma once

/// One journal of a study: a file of chunks, each a record with a checksum.
///
///     index, samples, bytes of payload (64 bits each)
///     payload: status (8 bits each), values (64 or, of a study in single precision, 32 bits each)
///     checksum of all before it in the record (64 bits, FNV-1a)

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "condyle/results/study_identity.h"
#include "condyle/results/sync_file.h"
#include "condyle/study/study_chunk.h"

namespace condyle {

/// How large the records of a study are.
struct ChunkLayout {
  std::uint64_t samples = 0;  ///< of the study
  std::size_t poses = 0, outputs = 0;
  bool single_precision = false;
  [[nodiscard]] std::uint64_t chunks() const {
    return (samples + kChunkSamples - 1) / kChunkSamples;
  }
  [[nodiscard]] std::uint64_t samples_in(std::uint64_t chunk) const;
  [[nodiscard]] std::size_t payload_bytes(std::uint64_t chunk) const;
  [[nodiscard]] std::size_t record_bytes(std::uint64_t chunk) const;
};
[[nodiscard]] ChunkLayout chunk_layout(const StudyPlan& plan);

[[nodiscard]] std::string record_of(const StudyChunk& chunk, const ChunkLayout& layout);
/// The chunk of which all bytes are there and fit.
[[nodiscard]] std::optional<StudyChunk> chunk_of(std::string_view record,
                                                 const ChunkLayout& layout);
/// The record at `at`, or what there is of it.
[[nodiscard]] std::string read_record(const std::filesystem::path& file,
                                      std::uint64_t at,
                                      std::uint64_t chunk,
                                      const ChunkLayout& layout);

/// Calls `found` for each whole chunk from `at` on (0: the head, of which InputError is thrown where
/// it is of another study), passing over those whose checksum does not fit, up to the first that is torn
/// or does not begin as a chunk; returns where that is.
std::uint64_t find_chunks(const std::filesystem::path& file,
                          std::uint64_t at,
                          const ChunkLayout& layout,
                          const StudyIdentity& identity,
                          const std::function<void(std::uint64_t chunk, std::uint64_t at)>& found);

/// A journal that grows. Belongs to one worker.
class ChunkWriter {
 public:
  /// A new file; the name gets a number where it is taken. Throws InputError.
  ChunkWriter(const std::filesystem::path& folder,
              const std::string& name,
              const StudyIdentity& identity);
  ChunkWriter(const ChunkWriter&) = delete;
  ChunkWriter& operator=(const ChunkWriter&) = delete;
  ~ChunkWriter();

  /// In one write, which the next one after a second brings to the disk; returns where it begins. Throws InputError where it
  /// cannot be written, and then the file is as before, and where the disk refused what was written before.
  std::uint64_t append(const std::string& bytes);
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
  SyncNowAndThen sync_;
};

}  // namespace condyle
