#include "condyle/results/journal.h"

#include <fmt/format.h>

#include <charconv>

#include "condyle/input_error.h"
#include "condyle/results/format_number.h"
#include "condyle/results/journal_line.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFirstWords = "condyle journal ";
constexpr std::string_view kFormat = "condyle journal 1 scene ";
constexpr std::string_view kSurfaces = " surfaces ";

std::string head(const RunIdentity& identity) {
  return fmt::format("{}{:016x}{}{:016x}\n", kFormat, identity.scene, kSurfaces, identity.surfaces);
}

/// Takes a word and a hash off the front of the head.
bool take_hash(std::string_view& text, std::string_view word, std::uint64_t& hash) {
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  const std::from_chars_result end =
      std::from_chars(text.data(), text.data() + text.size(), hash, 16);
  text.remove_prefix(static_cast<std::size_t>(end.ptr - text.data()));
  return end.ec == std::errc();
}

bool read_head(const fs::path& path, std::string_view text, JournalContents& contents) {
  const bool torn = text.find('\n') == std::string_view::npos;
  if (torn && kFirstWords.starts_with(text.substr(0, kFirstWords.size()))) return false;
  if (!text.starts_with(kFirstWords)) {
    throw InputError(path.string() +
                     ": is no journal of a sweep, expected this name to be free for one");
  }
  if (torn) return false;
  std::string_view line = text.substr(0, text.find('\n'));
  contents.whole_bytes = line.size() + 1;
  const std::string later = later_format(line, "condyle journal 1");
  if (!later.empty()) throw InputError(path.string() + ": " + later);
  if (!take_hash(line, kFormat, contents.identity.scene) ||
      !take_hash(line, kSurfaces, contents.identity.surfaces) || !line.empty()) {
    throw InputError(path.string() + ": is a journal of another format, expected \"" +
                     std::string(kFirstWords) + "1\"");
  }
  return true;
}

}  // namespace

fs::path journal_path(const fs::path& run) { return run.string() + ".journal"; }

JournalContents read_journal(const fs::path& path, const Scene& scene) {
  JournalContents journal;
  const std::string text = bytes_of_file(path);
  journal.started = !text.empty() && read_head(path, text, journal);
  if (!journal.started) return journal;
  KnownPose known;
  for (;;) {
    const std::size_t end = text.find('\n', journal.whole_bytes);
    if (end == std::string::npos) return journal;
    const std::string_view line =
        std::string_view(text).substr(journal.whole_bytes, end - journal.whole_bytes);
    if (!read_journal_line(line, scene.contacts.size(), scene.conditions.size(), known))
      return journal;
    journal.poses.push_back(known);
    journal.whole_bytes = end + 1;
  }
}

Journal::Journal(LineFile& file, const RunIdentity& identity, std::size_t kept_bytes)
    : file_(file), head_(kept_bytes == 0 ? head(identity) : "") {
  file_.keep(kept_bytes);
}

void Journal::append(const KnownPose& known) {
  line_ = head_;
  head_.clear();
  write_journal_line(known, line_);
  file_.append(line_);
}

}  // namespace condyle
