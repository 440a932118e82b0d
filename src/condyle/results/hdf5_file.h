#pragma once

/// Files of HDF5. They are built in memory and handed out as bytes, so that a full disk is met by a plain write
/// and never by HDF5 half-way through its own; those that may be larger than memory, on disk.

#include <filesystem>
#include <memory>
#include <string>

#include "condyle/results/hdf5_group.h"
#include "condyle/results/hdf5_handle.h"
#include "condyle/results/hdf5_process.h"
#include "condyle/results/read_by.h"

namespace condyle {

/// A file being built in memory. Groups must be gone before `bytes` is asked.
class Hdf5Builder {
 public:
  explicit Hdf5Builder(const std::string& file);
  [[nodiscard]] Hdf5Group root() const;
  [[nodiscard]] std::string bytes() const;

 private:
  Hdf5Handle file_;
  std::string name_;
};

/// A new file on disk. Groups and datasets must be gone before `close`, which throws InputError where
/// not all of it could be written.
class Hdf5DiskFile {
 public:
  /// `named`: what errors call it, the file that it becomes.
  Hdf5DiskFile(const std::filesystem::path& file, std::string named);
  [[nodiscard]] Hdf5Group root() const;
  void close();

 private:
  Hdf5Handle file_;
  std::string name_;
};

class Hdf5Reader {
 public:
  /// Throws InputError; DamagedFile where the process that reads it does not live to say what is wrong.
  explicit Hdf5Reader(const std::filesystem::path& file, ReadBy by = ReadBy::kProcessOfItsOwn);
  [[nodiscard]] Hdf5Group root() const;

 private:
  std::shared_ptr<Hdf5Process> process_;
  Hdf5Handle file_;
  std::string name_;
};

}  // namespace condyle
