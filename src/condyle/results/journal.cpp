#include "condyle/results/journal.h"

#include <map>
#include <utility>

#include "condyle/results/journal_line.h"
#include "condyle/results/sweep_record.h"

namespace condyle {
namespace {

constexpr JournalKind kSweepJournal = {"condyle journal 1", "a sweep"};

/// Of the lines of one pose the last.
std::vector<KnownPose> each_once(std::vector<KnownPose> lines) {
  std::map<std::pair<double, int>, std::size_t> last;
  for (std::size_t i = 0; i < lines.size(); ++i) last[{lines[i].pose.value, lines[i].visit}] = i;
  std::vector<KnownPose> poses;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (last[{lines[i].pose.value, lines[i].visit}] == i) poses.push_back(std::move(lines[i]));
  return poses;
}

}  // namespace

JournalContents read_journal(const std::filesystem::path& path, const Scene& scene) {
  JournalContents journal;
  const std::string text = bytes_of_file(path);
  const std::optional<JournalHead> head =
      read_journal_head(path.string(), text, kSweepJournal, run_parts({}, scene));
  if (!head) return journal;
  journal.started = true;
  journal.identity = {head->hashes[0], head->hashes[1]};
  journal.whole_bytes = read_journal_lines(text, head->bytes, [&](std::string_view line) {
    KnownPose known;
    if (!read_journal_line(line, scene.contacts.size(), scene.conditions.size(), known) ||
        !belongs_to(scene, known))
      return false;
    journal.poses.push_back(std::move(known));
    return true;
  });
  journal.poses = each_once(std::move(journal.poses));
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
