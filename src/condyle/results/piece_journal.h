#pragma once

/// The journal (journal_file.h) of a work that consists of sweeps, a line for each when it is done:
///
///     condyle laxity 1 scene HASH surfaces HASH asked HASH program HASH
///     sweep NUMBER ... HASH
///
/// (or condyle compare 1). A sweep is all that is told of its poses, to the last bit, so that it is
/// taken over as it is: "asked" hashes the values of the sweep and what the reference model is made of.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "condyle/compare/compare.h"
#include "condyle/results/journal_file.h"

namespace condyle {

inline constexpr JournalKind kLaxityJournal = {"condyle laxity 1", "a test of laxity"};
inline constexpr JournalKind kCompareJournal = {"condyle compare 1", "a comparison"};

[[nodiscard]] JournalParts comparison_parts(const Scene& scene,
                                            const std::vector<FittedSurface>& surfaces,
                                            const CompareOptions& options);

struct PieceContents {
  std::map<int, SweepResult> sweeps;  ///< by their number
  std::optional<JournalHead> head;    ///< where it is whole
  std::size_t whole_bytes = 0;        ///< up to the end of the last whole line
};

/// What a journal holds, of whatever parts, nothing where there is none. Throws InputError for a file
/// that is no such journal.
[[nodiscard]] PieceContents read_piece_journal(const std::filesystem::path& path,
                                               const JournalKind& kind,
                                               const JournalParts& parts,
                                               const Scene& scene);

class PieceJournal : public JournalLines {
 public:
  using JournalLines::JournalLines;

  void append(int number, const SweepResult& sweep);
};

}  // namespace condyle
