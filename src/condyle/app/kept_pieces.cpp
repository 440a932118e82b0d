#include "condyle/app/kept_pieces.h"

#include <fmt/format.h>

#include <utility>

namespace condyle {
namespace {

PieceContents earlier_pieces(const Talk& talk,
                             const std::filesystem::path& output,
                             bool resume,
                             const JournalKind& kind,
                             const JournalParts& parts,
                             const Scene& scene) {
  PieceContents journal = read_piece_journal(journal_path(output), kind, parts, scene);
  const std::size_t sweeps = journal.sweeps.size();
  say_what_is_resumed(talk, output, resume, journal.head, parts,
                      sweeps == 0 ? "" : fmt::format("{} sweeps", sweeps));
  return resume ? std::move(journal) : PieceContents{};
}

}  // namespace

KeptPieces::KeptPieces(const Talk& talk,
                       const std::filesystem::path& output,
                       bool resume,
                       const JournalKind& kind,
                       const JournalParts& parts,
                       const Scene& scene)
    : file_(journal_path(output), output),
      earlier_(earlier_pieces(talk, output, resume, kind, parts, scene)),
      journal_(file_, kind, parts, earlier_.whole_bytes),
      keeping_{std::move(earlier_.sweeps), {}} {
  if (!keeping_.known.empty()) words_.emplace(last_words(output, "sweeps"));
  keeping_.on_computed = [this, output](int number, const SweepResult& sweep) {
    journal_.append(number, sweep);
    if (!words_) words_.emplace(last_words(output, "sweeps"));
    ++computed_;
  };
}

void KeptPieces::write_result(const Talk& talk, const std::string& output, const Run& run) {
  if (!keeping_.known.empty())
    say(talk, "{} sweeps taken over, {} computed\n", keeping_.known.size(), computed_);
  write_and_end_journal(talk, output, run, journal_, "sweeps");
}

}  // namespace condyle
