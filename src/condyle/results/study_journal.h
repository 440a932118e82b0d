#pragma once

/// Chunks of a study under way, on disk: a folder beside the result, STUDY.h5.journal/, with a file for
/// each worker that ever wrote. Binary, little-endian, as the machine has it:
///
///     "condyle study 1\n", identity as lines of text (WHAT HASH), their checksum, a blank line
///     then chunks (study_chunk_file.h)
///
/// A chunk whose checksum does not fit, and what follows it in that file, is not read. The folder
/// belongs to one run at a time (locks by flock on files in it); runs of parts (--part i/n) share it,
/// each part once.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "condyle/results/study_folder.h"
#include "condyle/results/study_identity.h"
#include "condyle/study/study_chunk.h"

namespace condyle {

class StudyJournals {
 public:
  /// "STUDY.h5.journal"
  [[nodiscard]] static std::filesystem::path folder(const std::filesystem::path& result);

  /// Takes the folder of `result`, made where there is none. Without `resume` what is in it is removed
  /// (of a part: what that part wrote). Throws InputError where another run holds it, where it is no
  /// such folder, and, naming what, where the chunks in it are of another study.
  StudyJournals(const std::filesystem::path& result,
                const StudyPlan& plan,
                StudyPart part,
                bool resume);
  /// For the other processes of a team whose first one has taken the folder: reads what is there and
  /// appends to files of its own.
  [[nodiscard]] static StudyJournals join(const std::filesystem::path& result,
                                          const StudyPlan& plan);
  ~StudyJournals();
  StudyJournals(StudyJournals&&) noexcept;

  /// Chunks that are there.
  [[nodiscard]] bool has(std::uint64_t chunk) const;
  [[nodiscard]] std::uint64_t count() const;
  /// Those of the part that are not there, in order.
  [[nodiscard]] std::vector<std::uint64_t> missing() const;

  /// A file of its own for each worker; numbers need not be in order. Each is one write. Throws
  /// InputError (disk full); what was written before stays good. Several workers may append at the same
  /// time.
  void append(int worker, const StudyChunk& chunk);

  /// Looks at what others wrote (ranks, parts).
  void read_again();
  /// Throws InputError where it has been damaged since. To be asked from one thread.
  [[nodiscard]] StudyChunk read(std::uint64_t chunk) const;

  /// The study is complete: the folder is no longer needed.
  void remove();

 private:
  struct Parts;
  explicit StudyJournals(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace condyle
