#pragma once

/// The journal (journal_file.h) of a motion in time that is computed: a line for each stretch of it
/// (MotionStretch), with its frames to the last bit, from which the next one goes on.
///
///     condyle motion 1 scene HASH surfaces HASH mass HASH program HASH
///     stretch ... HASH
///     finer CONTACT R (9, by columns) p (3) HASH
///
/// After "finer" the motion was begun anew, with a finer lattice of a contact of layers: of the
/// stretches only those after the last such line count.

#include <filesystem>

#include "condyle/network/simulate.h"
#include "condyle/results/journal_file.h"

namespace condyle {

inline constexpr JournalKind kMotionJournal = {"condyle motion 1", "a motion"};

[[nodiscard]] JournalParts motion_parts(const Scene& scene,
                                        const std::vector<FittedSurface>& surfaces);

struct MotionContents {
  std::vector<LatticeRefinement> refinements;
  std::vector<MotionStretch> stretches;
  std::optional<JournalHead> head;           ///< where it is whole
  std::size_t whole_bytes = 0;               ///< up to the end of the last whole line
  [[nodiscard]] std::size_t frames() const;  ///< of all stretches
};

/// What a journal holds, of whatever parts, nothing where there is none. Throws InputError for a file
/// that is no such journal.
[[nodiscard]] MotionContents read_motion_journal(const std::filesystem::path& path,
                                                 const JournalParts& parts);

class MotionJournal : public JournalLines {
 public:
  using JournalLines::JournalLines;

  void append(const MotionStretch& stretch);
  void append(const LatticeRefinement& refinement);

 private:
  template <class Piece>
  void append_piece(std::string_view word, const Piece& piece);
};

}  // namespace condyle
