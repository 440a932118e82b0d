#include "condyle/app/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace condyle {
namespace {

constexpr double kPatience = 0.5;  // before the first line [s]
constexpr double kRedraw = 0.1;    // [s]
constexpr const char* kWipe = "\r\x1b[K";

bool terminal_watches() {
  const char* term = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

int terminal_width() {
  winsize size{};
  const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

std::string duration(double seconds) {
  const long s = std::max(1L, std::lround(seconds));
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {:02} s", s / 60, s % 60);
  return fmt::format("{} h {:02} min", s / 3600, s % 3600 / 60);
}

double between(std::chrono::steady_clock::time_point a, std::chrono::steady_clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

}  // namespace

std::string progress_line(const std::string& what, int done, int total, double seconds, int width) {
  const auto longest = static_cast<std::size_t>(std::max(0, width - 1));
  if (total <= 0)
    return fmt::format("{}  {} so far, {}", what, done, duration(seconds)).substr(0, longest);
  const std::string left =
      done > 0 ? fmt::format(", about {} left", duration(seconds * (total - done) / done)) : "";
  const std::string count = fmt::format("{} of {}{}", done, total, left);
  const int room = std::min(30, width - static_cast<int>(what.size() + count.size()) - 7);
  if (room < 5) return fmt::format("{}  {}", what, count).substr(0, longest);
  const int filled = static_cast<int>(static_cast<long>(room) * std::min(done, total) / total);
  return fmt::format("{}  [{:#<{}}{:-<{}}]  {}", what, "", filled, "", room - filled, count);
}

Progress::Progress(const Talk& talk, std::string what)
    : what_(std::move(what)), watched_(talk.plain() && terminal_watches()) {}

void Progress::at(int done, int total) {
  if (!watched_) return;
  const Clock::time_point now = Clock::now();
  const double seconds = between(start_, now);
  if (seconds < kPatience || (drawn_ && between(last_, now) < kRedraw)) return;
  const std::string line = progress_line(what_, done, total, seconds, terminal_width());
  std::fprintf(stderr, "%s%s", kWipe, line.c_str());
  std::fflush(stderr);
  last_ = now;
  drawn_ = true;
}

void Progress::clear() {
  if (!drawn_) return;
  std::fputs(kWipe, stderr);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace condyle
