/// Chunks of samples on threads: nobody's numbers depend on who computed what.

#include "condyle/study/study_chunk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <mutex>
#include <stdexcept>

#include "study/small_study.h"

namespace condyle::test {
namespace {

StudyPlan small_plan(long samples) {
  return study_plan(at_flexions(small_study("wismans-type/knee.toml", samples), {0, 20}));
}

std::vector<std::uint64_t> all_of(const StudyPlan& plan) {
  std::vector<std::uint64_t> all;
  for (std::uint64_t c = 0; c < chunk_count(plan); ++c) all.push_back(c);
  return all;
}

using Chunks = std::map<std::uint64_t, StudyChunk>;

Chunks computed(const StudyPlan& plan, int threads, std::vector<std::uint64_t> wanted) {
  Chunks chunks;
  std::mutex one_at_a_time;
  EXPECT_TRUE(run_chunks(plan, threads, chunks_from_counter(std::move(wanted)),
                         [&](int, const StudyChunk& chunk) {
                           const std::lock_guard lock(one_at_a_time);
                           EXPECT_TRUE(chunks.emplace(chunk.index, chunk).second);
                           return true;
                         }));
  return chunks;
}

void expect_same_bits(const Chunks& a, const Chunks& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [index, chunk] : a) {
    const StudyChunk& other = b.at(index);
    EXPECT_EQ(chunk.samples, other.samples);
    EXPECT_EQ(chunk.status, other.status);
    ASSERT_EQ(chunk.values.size(), other.values.size());
    EXPECT_EQ(
        std::memcmp(chunk.values.data(), other.values.data(), chunk.values.size() * sizeof(double)),
        0);
  }
}

TEST(StudyChunks, AreTheSameOnAnyNumberOfThreadsAndInAnyOrder) {
  const StudyPlan plan = small_plan(5 * kChunkSamples + 3);
  const Chunks one = computed(plan, 1, all_of(plan));
  ASSERT_EQ(one.size(), 6u);
  EXPECT_EQ(one.at(5).samples, 3u);
  EXPECT_EQ(one.at(5).values.size(), 3 * plan.numbers());
  for (const int threads : {2, 3, 7}) {
    SCOPED_TRACE(threads);
    expect_same_bits(computed(plan, threads, all_of(plan)), one);
  }
  std::vector<std::uint64_t> reversed = all_of(plan);
  std::reverse(reversed.begin(), reversed.end());
  expect_same_bits(computed(plan, 2, reversed), one);
}

TEST(StudyChunks, TheCallingThreadIsAskedAfterEachOfItsSamplesAndMayStop) {
  const StudyPlan plan = small_plan(3 * kChunkSamples);
  int asked = 0, kept = 0;
  const KeepChunk keep = [&](int, const StudyChunk&) { return ++kept > 0; };
  EXPECT_FALSE(
      run_chunks(plan, 1, chunks_from_counter(all_of(plan)), keep, [&] { return ++asked < 70; }));
  EXPECT_EQ(asked, 70);
  EXPECT_EQ(kept, 1);  // the second was not whole
}

TEST(StudyChunks, StopWhereTheyAreNotKept) {
  const StudyPlan plan = small_plan(3 * kChunkSamples);
  int kept = 0;
  EXPECT_FALSE(run_chunks(plan, 1, chunks_from_counter(all_of(plan)),
                          [&](int, const StudyChunk&) { return ++kept < 2; }));
  EXPECT_EQ(kept, 2);
}

TEST(StudyChunks, AnExceptionOfAThreadIsThrownAgain) {
  const StudyPlan plan = small_plan(2 * kChunkSamples);
  const KeepChunk keep = [](int, const StudyChunk&) -> bool {
    throw std::runtime_error("disk full");
  };
  EXPECT_THROW(run_chunks(plan, 2, chunks_from_counter(all_of(plan)), keep), std::runtime_error);
}

}  // namespace
}  // namespace condyle::test
