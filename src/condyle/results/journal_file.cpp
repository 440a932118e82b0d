#include "condyle/results/journal_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

#include "condyle/input_error.h"
#include "condyle/results/format_number.h"
#include "condyle/version.h"

namespace condyle {
namespace {

/// What the heads of a kind begin with, of whatever format.
std::string_view first_words(const JournalKind& kind) {
  return kind.format.substr(0, kind.format.size() - 1);
}

void expect_first_words(const std::string& file, std::string_view text, const JournalKind& kind) {
  const std::string_view words = first_words(kind);
  if (!words.starts_with(text.substr(0, words.size())))
    throw InputError(fmt::format("{}: is no journal of {}, expected this name to be free for one",
                                 file, kind.work));
}

std::string head_of_journal(const JournalKind& kind, const JournalParts& parts) {
  std::string head(kind.format);
  for (const JournalPart& part : parts) head += fmt::format(" {} {:016x}", part.word, part.hash);
  return head + "\n";
}

/// Takes " WORD HASH" off the front of the head.
bool take_part(std::string_view& line, std::string_view word, std::uint64_t& hash) {
  const std::string before = fmt::format(" {} ", word);
  if (!line.starts_with(before)) return false;
  line.remove_prefix(before.size());
  const std::from_chars_result end =
      std::from_chars(line.data(), line.data() + line.size(), hash, 16);
  line.remove_prefix(static_cast<std::size_t>(end.ptr - line.data()));
  return end.ec == std::errc();
}

/// The line that begins at `at`, without its end; nothing where it has none.
std::optional<std::string_view> line_at(std::string_view text, std::size_t at) {
  const std::size_t end = text.find('\n', at);
  if (end == std::string_view::npos) return std::nullopt;
  return text.substr(at, end - at);
}

}  // namespace

std::filesystem::path journal_path(const std::filesystem::path& run) {
  return run.string() + ".journal";
}

JournalParts run_parts(const RunIdentity& identity, const Scene& scene) {
  return {{"scene", identity.scene,
           fmt::format("another text of the scene, expected that of {}", scene.file.string())},
          {"surfaces", identity.surfaces,
           "other patches, expected those fitted now (a mesh has changed, or the program)"}};
}

JournalPart program_part() {
  return {"program", hash_bytes(CONDYLE_VERSION),
          "another version of condyle, expected this one: " CONDYLE_VERSION};
}

void expect_journal(const std::filesystem::path& path, const JournalKind& kind) {
  const std::string text = bytes_of_file(path).substr(0, first_words(kind).size());
  expect_first_words(path.string(), text, kind);
}

std::optional<JournalHead> read_journal_head(const std::string& file,
                                             std::string_view text,
                                             const JournalKind& kind,
                                             const JournalParts& parts) {
  expect_first_words(file, text, kind);
  const std::optional<std::string_view> whole = line_at(text, 0);
  if (!whole) return std::nullopt;
  std::string_view line = *whole;
  const std::string later = later_format(line, kind.format);
  if (!later.empty()) throw InputError(file + ": " + later);
  JournalHead head;
  head.bytes = line.size() + 1;
  bool ok = line.starts_with(kind.format);
  if (ok) line.remove_prefix(kind.format.size());
  for (const JournalPart& part : parts)
    ok = ok && take_part(line, part.word, head.hashes.emplace_back());
  if (!ok || !line.empty())
    throw InputError(
        fmt::format("{}: is a journal of another format, expected \"{}\"", file, kind.format));
  return head;
}

bool same_parts(const JournalHead& head, const JournalParts& parts) {
  return std::ranges::equal(head.hashes, parts, {}, {}, &JournalPart::hash);
}

void expect_same_parts(const std::string& file,
                       const JournalHead& head,
                       const JournalParts& parts) {
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (head.hashes.at(i) != parts[i].hash)
      throw InputError(fmt::format("{}: belongs to {}", file, parts[i].another));
}

std::size_t read_journal_lines(std::string_view text,
                               std::size_t bytes,
                               const std::function<bool(std::string_view)>& take) {
  while (const std::optional<std::string_view> line = line_at(text, bytes)) {
    if (!take(*line)) break;
    bytes += line->size() + 1;
  }
  return bytes;
}

JournalLines::JournalLines(LineFile& file,
                           const JournalKind& kind,
                           const JournalParts& parts,
                           std::size_t kept_bytes)
    : file_(file), head_(kept_bytes == 0 ? head_of_journal(kind, parts) : "") {
  file_.keep(kept_bytes);
}

void JournalLines::append_line(const std::string& line) {
  file_.append(head_ + line);
  head_.clear();
}

}  // namespace condyle
