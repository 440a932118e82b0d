#include "condyle/results/study_chunk_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "condyle/input_error.h"
#include "condyle/results/format_number.h"
#include "condyle/results/run_identity.h"

namespace condyle {
namespace {

constexpr std::size_t kWord = sizeof(std::uint64_t), kHeadOfRecord = 3 * kWord;

void put_word(std::string& bytes, std::uint64_t word) {
  bytes.append(reinterpret_cast<const char*>(&word), kWord);
}

std::uint64_t word_at(std::string_view bytes, std::size_t at) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes.data() + at, kWord);
  return word;
}

/// Its payload's size fits a chunk of the study.
bool head_fits(std::string_view record, const ChunkLayout& layout) {
  const std::uint64_t chunk = word_at(record, 0);
  return chunk < layout.chunks() && word_at(record, kWord) == layout.samples_in(chunk) &&
         word_at(record, 2 * kWord) == layout.payload_bytes(chunk);
}

bool checksum_fits(std::string_view record) {
  const std::size_t end = record.size() - kWord;
  return hash_bytes(record.substr(0, end)) == word_at(record, end);
}

std::string read_some(std::ifstream& stream, std::size_t bytes) {
  std::string text(bytes, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(bytes));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  return text;
}

/// Where the chunks begin; 0: the head is torn or damaged. What does not begin as one, as zeros that a
/// crash may leave, is not read to its end.
std::uint64_t check_head(const std::filesystem::path& file, const StudyIdentity& identity) {
  constexpr std::size_t kPiece = 1 << 14;
  std::ifstream stream(file, std::ios::binary);
  std::string bytes = read_some(stream, kPiece);
  const std::string later = later_format(bytes, "condyle study 1");
  if (!later.empty()) throw InputError(fmt::format("{}: {}", file.string(), later));
  if (!begins_as_head(bytes)) return 0;
  for (std::size_t searched = 0; stream && bytes.find("\n\n", searched) == std::string::npos;) {
    searched = bytes.size() - 1;
    bytes += read_some(stream, kPiece);
  }
  const std::size_t size = head_size(bytes);
  if (size > 0)
    expect_same_study(file.parent_path().string(), std::string_view(bytes).substr(0, size),
                      identity);
  return size;
}

[[noreturn]] void cannot_write(const std::filesystem::path& path, int code) {
  throw InputError(fmt::format("{}: cannot be written: {}", path.string(),
                               std::generic_category().message(code)));
}

}  // namespace

std::uint64_t ChunkLayout::samples_in(std::uint64_t chunk) const {
  return std::min(kChunkSamples, samples - chunk * kChunkSamples);
}

std::size_t ChunkLayout::payload_bytes(std::uint64_t chunk) const {
  const std::size_t number = single_precision ? sizeof(float) : sizeof(double);
  return samples_in(chunk) * poses * (1 + outputs * number);
}

std::size_t ChunkLayout::record_bytes(std::uint64_t chunk) const {
  return kHeadOfRecord + payload_bytes(chunk) + kWord;
}

ChunkLayout chunk_layout(const StudyPlan& plan) {
  return {plan.samples(), plan.values.size(), plan.outputs.size(), plan.study.single_precision};
}

std::string record_of(const StudyChunk& chunk, const ChunkLayout& layout) {
  std::string bytes;
  bytes.reserve(layout.record_bytes(chunk.index));
  put_word(bytes, chunk.index);
  put_word(bytes, chunk.samples);
  put_word(bytes, layout.payload_bytes(chunk.index));
  bytes.append(reinterpret_cast<const char*>(chunk.status.data()), chunk.status.size());
  if (layout.single_precision) {
    const std::vector<float> values(chunk.values.begin(), chunk.values.end());
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  } else {
    bytes.append(reinterpret_cast<const char*>(chunk.values.data()),
                 chunk.values.size() * sizeof(double));
  }
  put_word(bytes, hash_bytes(bytes));
  return bytes;
}

std::optional<StudyChunk> chunk_of(std::string_view record, const ChunkLayout& layout) {
  if (record.size() < kHeadOfRecord || !head_fits(record, layout)) return std::nullopt;
  StudyChunk chunk;
  chunk.index = word_at(record, 0);
  chunk.samples = word_at(record, kWord);
  if (record.size() != layout.record_bytes(chunk.index) || !checksum_fits(record))
    return std::nullopt;
  const std::size_t poses = chunk.samples * layout.poses;
  const char* at = record.data() + kHeadOfRecord;
  chunk.status.assign(at, at + poses);
  chunk.values.resize(poses * layout.outputs);
  at += poses;
  if (layout.single_precision) {
    std::vector<float> values(chunk.values.size());
    std::memcpy(values.data(), at, values.size() * sizeof(float));
    chunk.values.assign(values.begin(), values.end());
  } else {
    std::memcpy(chunk.values.data(), at, chunk.values.size() * sizeof(double));
  }
  return chunk;
}

std::string read_record(const std::filesystem::path& file,
                        std::uint64_t at,
                        std::uint64_t chunk,
                        const ChunkLayout& layout) {
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(at));
  return read_some(stream, layout.record_bytes(chunk));
}

std::uint64_t find_chunks(const std::filesystem::path& file,
                          std::uint64_t at,
                          const ChunkLayout& layout,
                          const StudyIdentity& identity,
                          const std::function<void(std::uint64_t, std::uint64_t)>& found) {
  if (at == 0) at = check_head(file, identity);
  if (at == 0) return 0;
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(at));
  while (stream) {
    std::string record = read_some(stream, kHeadOfRecord);
    if (record.size() < kHeadOfRecord || !head_fits(record, layout)) break;
    const std::uint64_t chunk = word_at(record, 0);
    record += read_some(stream, layout.record_bytes(chunk) - kHeadOfRecord);
    if (record.size() != layout.record_bytes(chunk)) break;
    if (checksum_fits(record)) found(chunk, at);
    at += record.size();
  }
  return at;
}

ChunkWriter::ChunkWriter(const std::filesystem::path& folder,
                         const std::string& name,
                         const StudyIdentity& identity) {
  for (int i = 0; descriptor_ < 0; ++i) {
    path_ = folder / fmt::format("{}.{}.chunks", name, i);
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST) cannot_write(path_, errno);
  }
  try {
    append(head_of(identity));
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

ChunkWriter::~ChunkWriter() { ::close(descriptor_); }

std::uint64_t ChunkWriter::append(const std::string& bytes) {
  std::size_t done = 0;
  int code = 0;
  while (done < bytes.size() && code == 0) {
    const ssize_t written = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno != EINTR) code = errno;
    if (written == 0) code = ENOSPC;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  if (code != 0) {
    if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0) size_ = 0;  // torn: not read
    cannot_write(path_, code);
  }
  const std::uint64_t at = size_;
  size_ += bytes.size();
  if (const int refused = sync_.wrote(descriptor_, path_); refused != 0)
    cannot_write(path_, refused);
  return at;
}

}  // namespace condyle
