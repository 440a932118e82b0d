#pragma once

/// What a process may use that was made to read a file of a stranger by a library of others: it may crash
/// as it likes, and nobody hears of it.

namespace condyle {

struct ChildLimits {
  double seconds = 60;               ///< of processor time
  double memory = 4.0 * (1L << 30);  ///< address space beyond what this process has [bytes]
};

/// For the child, first of all. A signal ends it at once and leaves nothing behind: no core, no words on the
/// terminal. Memory is not limited where sanitizers take all of the address space. Of open files it keeps the `channel` to
/// the process that made it, and what another program would inherit: the lock on an output ends with the process that took
/// it, though a child may live for a moment longer.
void confine(const ChildLimits& limits, int channel);

}  // namespace condyle
