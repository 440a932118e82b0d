#pragma once

/// One pose as a line of the journal (journal.h says how it looks).

#include <string>
#include <string_view>

#include "condyle/equilibrium/known_poses.h"

namespace condyle {

/// Appends the line, with its end.
void write_journal_line(const KnownPose& known, std::string& out);

/// Reads a line without its end. False where it is not whole, or names contacts or conditions that
/// are not there.
[[nodiscard]] bool read_journal_line(std::string_view line,
                                     std::size_t contacts,
                                     std::size_t conditions,
                                     KnownPose& known);

}  // namespace condyle
