#pragma once

/// What a process may use that was made to read a file of a stranger by a library of others: it may crash
/// as it likes, and nobody hears of it.

namespace condyle {

struct ChildLimits {
  double seconds = 60;               ///< of processor time
  double memory = 4.0 * (1L << 30);  ///< address space beyond what this process has [bytes]
};

/// For the child, first of all. A signal ends it at once and leaves nothing behind: no core, no words on the
/// terminal. Memory is not limited where sanitizers take all of the address space.
void confine(const ChildLimits& limits);

}  // namespace condyle
