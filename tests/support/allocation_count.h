#pragma once

namespace condyle::test {

/// Heap allocations of this thread since construction, counted in malloc, where Eigen allocates
/// too.
///
///     const AllocationCount count;
///     ...
///     EXPECT_EQ(count.since_start(), 0);
///
/// Under a sanitizer, which has a malloc of its own, the count is always 0.
class AllocationCount {
 public:
  AllocationCount();
  [[nodiscard]] long since_start() const;

 private:
  long start_;
};

/// Heap that all threads hold beyond what they held at construction [bytes], as malloc hands it
/// out. Where one of these counts, no other does: they share the peak.
class HeapUse {
 public:
  HeapUse();
  [[nodiscard]] long bytes() const;  ///< now
  [[nodiscard]] long peak() const;   ///< the most since construction

 private:
  long start_;
};

/// False where the count is always 0.
[[nodiscard]] bool allocations_are_counted();

}  // namespace condyle::test
