#pragma once

/// HDF5 checks little of what a file says about itself: a damaged one may have it read or write where nothing is, ask for any
/// amount of memory, or go round for ever. A file of a stranger is therefore held open by a process of its own, which may crash
/// as it likes and hands out values; nothing of what it says is taken on trust but the values themselves.

#include <sys/types.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "condyle/input_error.h"
#include "condyle/mesh_files/child_limits.h"
#include "condyle/results/hdf5_question.h"

namespace condyle {

/// A file that the process which read it did not survive.
struct DamagedFile : InputError {
  using InputError::InputError;
};

class Hdf5Process {
 public:
  using Answering = std::function<Hdf5Answer(const Hdf5Question&)>;

  /// `open` is called in the new process, which has 5 s of processor time and 1 GB of memory for a small file, more for a large
  /// one. Throws what `open` throws, and DamagedFile where the process does not live to answer. It answers the process that
  /// opened the file, and no copy of that (fork).
  Hdf5Process(const std::filesystem::path& file, const std::function<Answering()>& open);

  /// Throws InputError as the other process did and to a copy of the process that opened the file, std::bad_alloc for
  /// want of memory on either side, and DamagedFile. From any thread, one at a time.
  [[nodiscard]] Hdf5Answer ask(const Hdf5Question& question);

 private:
  struct Child {
    pid_t id = -1, of = -1;  ///< and of which process
    Child() = default;
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child();
  };
  struct CloseStream {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
  };
  [[nodiscard]] Hdf5Answer receive();
  [[noreturn]] void damaged() const;

  std::string name_;
  ChildLimits limits_;
  std::mutex mutex_;
  Child child_;
  std::unique_ptr<std::FILE, CloseStream> stream_;  ///< what it answers
  bool in_step_ = true;                             ///< all of the last answer was taken
};

}  // namespace condyle
