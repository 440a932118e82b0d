#pragma once

/// Chunks of a study under way, on disk: a folder beside the result, STUDY.h5.journal/, with a file for
/// each worker that ever wrote. Binary, little-endian, as the machine has it:
///
///     "condyle study 1\n", identity as lines of text (WHAT HASH), a blank line
///     then chunks: index, samples, bytes of payload (64 bits each), payload, checksum of all of it
///
/// A chunk whose checksum does not fit, and what follows it in that file, is not read. The folder
/// belongs to one run at a time; runs of parts (--part i/n) share it, each part once.

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "condyle/study/study_chunk.h"

namespace condyle {

/// What samples depend on: hashes by name, "study", "scene knee.toml", "surfaces knee.toml", "design
/// table", "program".
using StudyIdentity = std::vector<std::pair<std::string, std::uint64_t>>;
[[nodiscard]] StudyIdentity study_identity(const StudyPlan& plan);

/// Part i of n, 1 <= i <= n: the chunks c with c % n == i - 1.
struct StudyPart {
  int i = 1, n = 1;
  [[nodiscard]] bool whole() const { return n == 1; }
};

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
  ~StudyJournals();

  /// Chunks that are there.
  [[nodiscard]] bool has(std::uint64_t chunk) const;
  [[nodiscard]] std::uint64_t count() const;
  /// Those of the part that are not there, in order.
  [[nodiscard]] std::vector<std::uint64_t> missing() const;

  /// A file of its own for each worker; numbers need not be in order. Each is one write. Throws
  /// InputError (disk full). Several workers may append at the same time.
  void append(int worker, const StudyChunk& chunk);

  /// Looks at what others wrote (ranks, parts).
  void read_again();
  [[nodiscard]] StudyChunk read(std::uint64_t chunk) const;

  /// The study is complete: the folder is no longer needed.
  void remove();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace condyle
