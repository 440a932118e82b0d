#include "support/allocation_count.h"

#include <cstddef>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CONDYLE_COUNTS_ALLOCATIONS 1
#else
#define CONDYLE_COUNTS_ALLOCATIONS 0
#endif

namespace {
thread_local long allocations_of_thread = 0;
}

#if CONDYLE_COUNTS_ALLOCATIONS
// The program's malloc and its relatives take the place of the C library's, which stays reachable
// by these names.
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT
void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT
void* __libc_realloc(void* block, std::size_t size);             // NOLINT
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT

void* malloc(std::size_t size) {  // NOLINT
  ++allocations_of_thread;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {  // NOLINT
  ++allocations_of_thread;
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {  // NOLINT
  ++allocations_of_thread;
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {  // NOLINT
  ++allocations_of_thread;
  return __libc_memalign(alignment, size);
}
}
#endif

namespace condyle::test {

AllocationCount::AllocationCount() : start_(allocations_of_thread) {}

long AllocationCount::since_start() const { return allocations_of_thread - start_; }

bool allocations_are_counted() { return CONDYLE_COUNTS_ALLOCATIONS != 0; }

}  // namespace condyle::test
