#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <system_error>

#include "condyle/input_error.h"
#include "condyle/results/study_chunk_file.h"
#include "condyle/results/study_file.h"

namespace condyle {
namespace {

namespace fs = std::filesystem;

/// Heads, summaries and the like.
constexpr std::uint64_t kAllElse = 1 << 20;

/// a * b + c, or the greatest number there is.
std::uint64_t bytes_of(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  std::uint64_t bytes = 0;
  const bool beyond =
      __builtin_mul_overflow(a, b, &bytes) || __builtin_add_overflow(bytes, c, &bytes);
  return beyond ? std::numeric_limits<std::uint64_t>::max() : bytes;
}

std::uint64_t journal_bytes(const StudyPlan& plan) {
  const ChunkLayout layout = chunk_layout(plan);
  return layout.samples == 0 ? 0 : bytes_of(layout.chunks(), layout.record_bytes(0), 0);
}

std::uint64_t result_bytes(const StudyPlan& plan) {
  const std::uint64_t number = plan.study.single_precision ? sizeof(float) : sizeof(double);
  const std::uint64_t sample = plan.parameters.size() * sizeof(double) + sizeof(std::int32_t) +
                               plan.values.size() * (1 + plan.outputs.size() * number);
  return bytes_of(plan.samples(), sample, kAllElse);
}

std::uint64_t bytes_in(const fs::path& folder) {
  std::uint64_t bytes = 0;
  std::error_code unknown;
  for (const auto& entry : fs::directory_iterator(folder, unknown)) {
    const std::uint64_t size = entry.file_size(unknown);
    if (!unknown) bytes += size;
  }
  return bytes;
}

std::string in_words(std::uint64_t bytes) {
  constexpr double kMega = 1e6, kGiga = 1e9;
  const auto size = static_cast<double>(bytes);
  return size < kGiga ? fmt::format("{:.1f} MB", size / kMega)
                      : fmt::format("{:.1f} GB", size / kGiga);
}

}  // namespace

std::uint64_t study_bytes(const StudyPlan& plan) {
  return bytes_of(journal_bytes(plan), 1, result_bytes(plan));
}

void expect_room(const fs::path& result, const StudyPlan& plan) {
  const std::uint64_t whole = study_bytes(plan), there = bytes_in(StudyJournals::folder(result));
  const std::uint64_t needed = whole - std::min(whole, there);
  std::error_code error;
  const fs::path folder = result.has_parent_path() ? result.parent_path() : fs::path(".");
  const fs::space_info space = fs::space(folder, error);
  if (error || needed <= space.available) return;
  throw InputError(
      fmt::format("{}: needs {}, the disk has {}, expected fewer samples or outputs, or float32",
                  result.string(), in_words(needed), in_words(space.available)));
}

}  // namespace condyle
