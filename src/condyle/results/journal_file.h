#pragma once

/// What all journals of a work under way share. A journal is a text file beside the result file. Its
/// head says of which work it is and what that depends on; each line after it holds a piece of the work
/// that is done, and ends with a hash of itself:
///
///     condyle journal 1 scene HASH surfaces HASH
///     ...  HASH
///
/// A line that was torn is known as such, and what follows it is not read. A work that is killed leaves
/// its journal behind, and a later one goes on from it; a work that is done removes it.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "condyle/results/line_file.h"
#include "condyle/results/run_identity.h"

namespace condyle {

/// "RUN.h5.journal"
[[nodiscard]] std::filesystem::path journal_path(const std::filesystem::path& run);

struct JournalKind {
  std::string_view format;  ///< "condyle journal 1"
  std::string_view work;    ///< "a sweep"
};

/// One of the things that a work depends on.
struct JournalPart {
  std::string_view word;  ///< before its hash in the head
  std::uint64_t hash = 0;
  std::string another;  ///< of another one: "another text of the scene, expected that of knee.toml"
};
using JournalParts = std::vector<JournalPart>;
/// "scene" and "surfaces" of a run.
[[nodiscard]] JournalParts run_parts(const RunIdentity& identity, const Scene& scene);
/// "program": of a journal whose contents are taken over as they are, without being solved anew.
[[nodiscard]] JournalPart program_part();

struct JournalHead {
  std::vector<std::uint64_t> hashes;  ///< of the parts, in order
  std::size_t bytes = 0;              ///< with the end of its line
};

/// Throws InputError where something else than a journal of that kind stands at `path`.
void expect_journal(const std::filesystem::path& path, const JournalKind& kind);

/// The head of a journal with these parts, of which only the words are read; nothing where `text` is
/// empty or ends within the head. Throws InputError naming `file` for what is no journal of that kind,
/// and for one of another format.
[[nodiscard]] std::optional<JournalHead> read_journal_head(const std::string& file,
                                                           std::string_view text,
                                                           const JournalKind& kind,
                                                           const JournalParts& parts);

[[nodiscard]] bool same_parts(const JournalHead& head, const JournalParts& parts);
/// Throws InputError, naming the first that differs, where a journal belongs to other parts.
void expect_same_parts(const std::string& file, const JournalHead& head, const JournalParts& parts);

/// Hands the lines after the first `bytes` of a journal, each without its end, to `take`, which says whether one is
/// whole and of this work. The bytes up to the first that is not.
[[nodiscard]] std::size_t read_journal_lines(std::string_view text,
                                             std::size_t bytes,
                                             const std::function<bool(std::string_view)>& take);

/// A journal that grows.
class JournalLines {
 public:
  /// Goes on after the first `kept_bytes`, or with 0 starts a new one. The file is taken before it is
  /// read (line_file.h) and stays. Throws InputError where it cannot be written.
  JournalLines(LineFile& file,
               const JournalKind& kind,
               const JournalParts& parts,
               std::size_t kept_bytes);

  /// The first failure ends the journal and is kept here.
  [[nodiscard]] const std::string& failure() const { return file_.failure(); }
  /// The work is complete: the journal is no longer needed.
  void remove() { file_.remove(); }

 protected:
  /// A line with its end, in one write.
  void append_line(const std::string& line);

 private:
  LineFile& file_;
  std::string head_;  ///< as long as it is not written: with the first line
};

}  // namespace condyle
