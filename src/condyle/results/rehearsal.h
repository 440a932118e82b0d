#pragma once

/// A result of a stranger is read in a child process first. HDF5 checks little of what a file says about
/// itself: a damaged one may have it read where nothing is, or ask for any amount of memory or time.

#include <filesystem>
#include <functional>

namespace condyle {

struct Run;
struct StudyView;

/// Calls `read` in a child process, which has 5 s of processor time and 1 GB of memory for a small file,
/// more for a large one. Throws InputError, naming `file`, where that does not live to its end; what else
/// `read` throws it will throw again, and is left to it.
void rehearse(const std::filesystem::path& file, const std::function<void()>& read);

/// read_run and read_study_file without a rehearsal: of a file that HDF5 itself has just written.
[[nodiscard]] Run read_run_at_once(const std::filesystem::path& path);
[[nodiscard]] StudyView read_study_file_at_once(const std::filesystem::path& path);

}  // namespace condyle
