#include "condyle/results/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <fstream>
#include <iterator>
#include <system_error>

#include "condyle/input_error.h"
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

std::string contents(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
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
  const std::string text = contents(path);
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

Journal::Journal(fs::path path, const RunIdentity& identity, std::size_t kept_bytes)
    : path_(std::move(path)) {
  const auto fail = [&](const std::string& why) {
    if (descriptor_ >= 0) ::close(descriptor_);
    throw InputError(path_.string() + ": " + why);
  };
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail("cannot be written: " + std::generic_category().message(errno));
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    fail("another run is writing it, expected an output of its own for each run");
  if (::ftruncate(descriptor_, static_cast<off_t>(kept_bytes)) != 0)
    fail("cannot be written: " + std::generic_category().message(errno));
  if (kept_bytes > 0) return;
  line_ = head(identity);
  write_line();
}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Journal::append(const KnownPose& known) {
  if (!failure_.empty()) return;
  line_.clear();
  write_journal_line(known, line_);
  write_line();
}

void Journal::write_line() {
  const ssize_t written = ::write(descriptor_, line_.data(), line_.size());
  if (written == static_cast<ssize_t>(line_.size())) return;
  failure_ = fmt::format("{}: cannot be written: {}", path_.string(),
                         std::generic_category().message(written < 0 ? errno : ENOSPC));
}

void Journal::remove() { ::unlink(path_.c_str()); }

}  // namespace condyle
