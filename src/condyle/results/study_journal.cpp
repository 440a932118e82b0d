#include "condyle/results/study_journal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <mutex>

#include "condyle/input_error.h"
#include "condyle/results/study_chunk_file.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kNoFile = ~std::uint32_t{0};

std::string prefix_of(StudyPart part) {
  return part.whole() ? "whole." : fmt::format("{}-of-{}.", part.i, part.n);
}

/// Names of journals differ between machines, processes and workers.
std::string process_name() {
  char host[256] = {};
  if (::gethostname(host, sizeof host - 1) != 0) host[0] = '\0';
  std::string name = host;
  std::replace(name.begin(), name.end(), '/', '-');
  return fmt::format("{}.{}", name, ::getpid());
}

}  // namespace

struct StudyJournals::Parts {
  struct ChunkPlace {
    std::uint32_t file = kNoFile;
    std::uint64_t at = 0;
  };

  struct KnownJournal {
    fs::path path;
    std::uint64_t end = 0;  ///< of its whole chunks; 0: nothing is known of it
  };

  struct OpenJournal {
    std::unique_ptr<ChunkWriter> writer;
    std::uint32_t file = kNoFile;
  };

  ChunkLayout layout;
  StudyIdentity identity;
  StudyPart part;
  std::unique_ptr<StudyFolder> folder;
  mutable std::mutex mutex;  ///< of what follows
  std::vector<KnownJournal> files;
  std::vector<ChunkPlace> places;  ///< by chunks
  std::uint64_t count = 0;
  std::map<int, OpenJournal> open;  ///< by workers

  Parts(const StudyPlan& plan, StudyPart its_part, std::unique_ptr<StudyFolder> its_folder)
      : layout(chunk_layout(plan)),
        identity(study_identity(plan)),
        part(its_part),
        folder(std::move(its_folder)),
        places(layout.chunks()) {}

  void keep(std::uint64_t chunk, ChunkPlace place) {
    if (places[chunk].file != kNoFile) return;
    places[chunk] = place;
    ++count;
  }

  std::uint32_t file_number(const fs::path& path) {
    for (std::size_t i = 0; i < files.size(); ++i)
      if (files[i].path == path) return static_cast<std::uint32_t>(i);
    files.push_back({path});
    return static_cast<std::uint32_t>(files.size() - 1);
  }

  void scan() {
    for (const fs::path& path : folder->journals()) {
      const std::uint32_t file = file_number(path);
      files[file].end = find_chunks(path, files[file].end, layout, identity,
                                    [&](std::uint64_t chunk, std::uint64_t at) {
                                      keep(chunk, {file, at});
                                    });
    }
  }

  OpenJournal& journal_of(int worker) {
    const auto known = open.find(worker);
    if (known != open.end()) return known->second;
    const std::string name = fmt::format("{}{}.{}", prefix_of(part), process_name(), worker);
    auto writer = std::make_unique<ChunkWriter>(folder->path(), name, identity);
    const std::uint32_t file = file_number(writer->path());
    return open[worker] = {std::move(writer), file};
  }
};

fs::path StudyJournals::folder(const fs::path& result) {
  fs::path path = result;
  path += ".journal";
  return path;
}

StudyJournals::StudyJournals(const fs::path& result,
                             const StudyPlan& plan,
                             StudyPart part,
                             bool resume)
    : parts_(std::make_unique<Parts>(
          plan, part, std::make_unique<StudyFolder>(folder(result), part))) {
  if (!resume) parts_->folder->remove_journals(part.whole() ? "" : prefix_of(part));
  parts_->scan();
}

StudyJournals::StudyJournals(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

StudyJournals StudyJournals::join(const fs::path& result, const StudyPlan& plan) {
  StudyJournals journals(
      std::make_unique<Parts>(plan, StudyPart{}, std::make_unique<StudyFolder>(folder(result))));
  journals.parts_->scan();
  return journals;
}

StudyJournals::~StudyJournals() = default;
StudyJournals::StudyJournals(StudyJournals&&) noexcept = default;

bool StudyJournals::has(std::uint64_t chunk) const {
  const std::lock_guard lock(parts_->mutex);
  return parts_->places.at(chunk).file != kNoFile;
}

std::uint64_t StudyJournals::count() const {
  const std::lock_guard lock(parts_->mutex);
  return parts_->count;
}

std::vector<std::uint64_t> StudyJournals::missing() const {
  const std::lock_guard lock(parts_->mutex);
  const auto step = static_cast<std::uint64_t>(parts_->part.n);
  std::vector<std::uint64_t> chunks;
  for (auto c = static_cast<std::uint64_t>(parts_->part.i - 1); c < parts_->places.size();
       c += step)
    if (parts_->places[c].file == kNoFile) chunks.push_back(c);
  return chunks;
}

void StudyJournals::append(int worker, const StudyChunk& chunk) {
  const std::string record = record_of(chunk, parts_->layout);
  Parts::OpenJournal* journal = nullptr;
  {
    const std::lock_guard lock(parts_->mutex);
    journal = &parts_->journal_of(worker);
  }
  const std::uint64_t at = journal->writer->append(record);
  const std::lock_guard lock(parts_->mutex);
  parts_->files[journal->file].end = at + record.size();
  parts_->keep(chunk.index, {journal->file, at});
}

void StudyJournals::read_again() {
  const std::lock_guard lock(parts_->mutex);
  parts_->scan();
}

StudyChunk StudyJournals::read(std::uint64_t chunk) const {
  const std::lock_guard lock(parts_->mutex);
  const Parts::ChunkPlace place = parts_->places.at(chunk);
  const fs::path path = parts_->files.at(place.file).path;
  std::optional<StudyChunk> there =
      chunk_of(read_record(path, place.at, chunk, parts_->layout), parts_->layout);
  if (!there || there->index != chunk)
    throw InputError(fmt::format(
        "{}: chunk {} has been damaged since it was written, --resume computes it again",
        path.string(), chunk));
  return std::move(*there);
}

void StudyJournals::remove() { parts_->folder->remove(); }

}  // namespace condyle
