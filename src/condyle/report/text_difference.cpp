#include "condyle/report/text_difference.h"

#include <algorithm>
#include <cstddef>
#include <sstream>

namespace condyle {
namespace {

using Kind = DifferenceLine::Kind;
using Lines = std::vector<std::string>;

constexpr std::ptrdiff_t kMostEdits = 2000;

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    lines.push_back(line);
  }
  return lines;
}

/// How far along each diagonal k (place in a minus place in b) so many edits lead.
using Reach = std::vector<std::ptrdiff_t>;

/// That of each number of edits from none on until both ends are met; empty where that takes too many.
std::vector<Reach> reaches(const Lines& a, const Lines& b) {
  const auto n = std::ssize(a), m = std::ssize(b);
  std::vector<Reach> all;
  Reach far(static_cast<std::size_t>(2 * kMostEdits + 3), 0);
  const auto at = [&](std::ptrdiff_t k) -> std::ptrdiff_t& {
    return far[static_cast<std::size_t>(k + kMostEdits + 1)];
  };
  for (std::ptrdiff_t d = 0; d <= std::min(n + m, kMostEdits); ++d) {
    for (std::ptrdiff_t k = -d; k <= d; k += 2) {
      const bool down = k == -d || (k != d && at(k - 1) < at(k + 1));
      std::ptrdiff_t x = down ? at(k + 1) : at(k - 1) + 1;
      while (x < n && x - k < m &&
             a[static_cast<std::size_t>(x)] == b[static_cast<std::size_t>(x - k)])
        ++x;
      at(k) = x;
      if (x >= n && x - k >= m) {
        all.emplace_back(&at(-d), &at(d) + 1);
        return all;
      }
    }
    all.emplace_back(&at(-d), &at(d) + 1);
  }
  return {};
}

/// From the end back to the beginning.
std::vector<DifferenceLine> walked_back(const Lines& a,
                                        const Lines& b,
                                        const std::vector<Reach>& all) {
  std::vector<DifferenceLine> lines;
  std::ptrdiff_t x = std::ssize(a), y = std::ssize(b);
  for (std::ptrdiff_t d = std::ssize(all) - 1; d >= 0; --d) {
    std::ptrdiff_t from = 0;  // where the edit ended
    bool down = false;
    if (d > 0) {
      const Reach& before = all[static_cast<std::size_t>(d - 1)];
      const auto far = [&](std::ptrdiff_t k) {
        return before[static_cast<std::size_t>(k + d - 1)];
      };
      const std::ptrdiff_t k = x - y;
      down = k == -d || (k != d && far(k - 1) < far(k + 1));
      from = down ? far(k + 1) : far(k - 1) + 1;
    }
    for (; x > from && y > 0; --x, --y)
      lines.push_back({Kind::kSame, a[static_cast<std::size_t>(x - 1)]});
    if (d == 0) break;
    if (down)
      lines.push_back({Kind::kOnlySecond, b[static_cast<std::size_t>(--y)]});
    else
      lines.push_back({Kind::kOnlyFirst, a[static_cast<std::size_t>(--x)]});
  }
  std::reverse(lines.begin(), lines.end());
  return lines;
}

std::vector<DifferenceLine> near_differences(const std::vector<DifferenceLine>& lines,
                                             std::size_t context) {
  std::vector<bool> kept(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].kind == Kind::kSame) continue;
    const std::size_t first = i > context ? i - context : 0;
    for (std::size_t j = first; j < std::min(lines.size(), i + context + 1); ++j) kept[j] = true;
  }
  std::vector<DifferenceLine> shown;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (kept[i])
      shown.push_back(lines[i]);
    else if (shown.empty() || shown.back().kind != Kind::kLeftOut)
      shown.push_back({Kind::kLeftOut, ""});
  }
  if (shown.size() == 1 && shown.front().kind == Kind::kLeftOut) shown.clear();
  return shown;
}

}  // namespace

std::optional<std::vector<DifferenceLine>> text_difference(const std::string& first,
                                                           const std::string& second,
                                                           std::size_t context) {
  const Lines a = lines_of(first), b = lines_of(second);
  const std::vector<Reach> all = reaches(a, b);
  if (all.empty()) return std::nullopt;
  return near_differences(walked_back(a, b, all), context);
}

}  // namespace condyle
