#pragma once

/// The sweeps that a test of laxity or a comparison consists of, in the journal of the command.

#include <filesystem>
#include <optional>
#include <string>

#include "condyle/app/interrupt.h"
#include "condyle/app/resume.h"
#include "condyle/results/piece_journal.h"

namespace condyle {

class KeptPieces {
 public:
  /// Takes the journal of `output`, reads what is to be resumed of it, and says so. Throws InputError
  /// where another run is writing it or, with `resume`, where it belongs to other parts.
  KeptPieces(const Talk& talk,
             const std::filesystem::path& output,
             bool resume,
             const JournalKind& kind,
             const JournalParts& parts,
             const Scene& scene);

  [[nodiscard]] const SweepKeeping& keeping() const { return keeping_; }
  [[nodiscard]] PieceJournal& journal() { return journal_; }

  /// Says how many sweeps were taken over, writes the result and removes the journal.
  void write_result(const Talk& talk, const std::string& output, const Run& run);

 private:
  LineFile file_;
  PieceContents earlier_;
  PieceJournal journal_;
  std::optional<LastWords> words_;  ///< as soon as it holds a sweep
  SweepKeeping keeping_;
  int computed_ = 0;
};

}  // namespace condyle
