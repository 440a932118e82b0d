#include "condyle/results/journal.h"

#include "condyle/results/journal_line.h"
#include "condyle/results/sweep_record.h"

namespace condyle {
namespace {

constexpr JournalKind kSweepJournal = {"condyle journal 1", "a sweep"};

}  // namespace

JournalContents read_journal(const std::filesystem::path& path, const Scene& scene) {
  JournalContents journal;
  const std::string text = bytes_of_file(path);
  const std::optional<JournalHead> head =
      read_journal_head(path.string(), text, kSweepJournal, run_parts({}, scene));
  if (!head) return journal;
  journal.started = true;
  journal.identity = {head->hashes[0], head->hashes[1]};
  journal.whole_bytes = head->bytes;
  KnownPose known;
  while (const std::optional<std::string_view> line = line_at(text, journal.whole_bytes)) {
    if (!read_journal_line(*line, scene.contacts.size(), scene.conditions.size(), known) ||
        !belongs_to(scene, known))
      break;
    journal.poses.push_back(known);
    journal.whole_bytes += line->size() + 1;
  }
  return journal;
}

Journal::Journal(LineFile& file, const RunIdentity& identity, std::size_t kept_bytes)
    : JournalLines(file, kSweepJournal, run_parts(identity, Scene()), kept_bytes) {}

void Journal::append(const KnownPose& known) {
  line_.clear();
  write_journal_line(known, line_);
  append_line(line_);
}

}  // namespace condyle
