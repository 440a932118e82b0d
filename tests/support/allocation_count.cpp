#include "support/allocation_count.h"

#include <atomic>
#include <cstddef>

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CONDYLE_COUNTS_ALLOCATIONS 1
#include <malloc.h>

#include <cerrno>
#else
#define CONDYLE_COUNTS_ALLOCATIONS 0
#endif

namespace {

thread_local long allocations_of_thread = 0;
std::atomic<long> live_bytes = 0, peak_bytes = 0;

}  // namespace

#if CONDYLE_COUNTS_ALLOCATIONS
// The program's malloc and its relatives take the place of the C library's, which stays reachable
// by these names.
extern "C" {
void* __libc_malloc(std::size_t size);                           // NOLINT
void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT
void* __libc_realloc(void* block, std::size_t size);             // NOLINT
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT
void __libc_free(void* block);                                   // NOLINT
}

namespace {

void* taken(void* block) {
  ++allocations_of_thread;
  if (!block) return block;
  const auto size = static_cast<long>(malloc_usable_size(block));
  const long live = live_bytes.fetch_add(size, std::memory_order_relaxed) + size;
  for (long peak = peak_bytes.load(std::memory_order_relaxed);
       live > peak && !peak_bytes.compare_exchange_weak(peak, live, std::memory_order_relaxed);) {
  }
  return block;
}

void given_back(void* block) {
  if (block)
    live_bytes.fetch_sub(static_cast<long>(malloc_usable_size(block)), std::memory_order_relaxed);
}

}  // namespace

extern "C" {
void* malloc(std::size_t size) { return taken(__libc_malloc(size)); }  // NOLINT
void* calloc(std::size_t count, std::size_t size) {                    // NOLINT
  return taken(__libc_calloc(count, size));
}
void* realloc(void* block, std::size_t size) {  // NOLINT
  given_back(block);
  return taken(__libc_realloc(block, size));
}
void* memalign(std::size_t alignment, std::size_t size) {  // NOLINT
  return taken(__libc_memalign(alignment, size));
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {  // NOLINT
  return taken(__libc_memalign(alignment, size));
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {  // NOLINT
  *block = taken(__libc_memalign(alignment, size));
  return *block ? 0 : ENOMEM;
}
void free(void* block) {  // NOLINT
  given_back(block);
  __libc_free(block);
}
}
#endif

namespace condyle::test {

AllocationCount::AllocationCount() : start_(allocations_of_thread) {}

long AllocationCount::since_start() const { return allocations_of_thread - start_; }

bool allocations_are_counted() { return CONDYLE_COUNTS_ALLOCATIONS != 0; }

HeapUse::HeapUse() : start_(live_bytes) { peak_bytes = start_; }

long HeapUse::bytes() const { return live_bytes - start_; }

long HeapUse::peak() const { return peak_bytes - start_; }

}  // namespace condyle::test
