#include "fuzz/memory_file.h"

#include <sys/mman.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <system_error>

namespace condyle::fuzz {

MemoryFile::MemoryFile(Bytes bytes) : descriptor_(memfd_create("door", 0)) {
  const bool written = descriptor_ >= 0 && ::write(descriptor_, bytes.data(), bytes.size()) ==
                                               static_cast<ssize_t>(bytes.size());
  if (!written) throw std::runtime_error("no file in memory");
  path_ = "/proc/self/fd/" + std::to_string(descriptor_);
}

MemoryFile::MemoryFile(const std::string& bytes)
    : MemoryFile(Bytes(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size())) {}

MemoryFile::~MemoryFile() { ::close(descriptor_); }

const std::filesystem::path& scratch() {
  struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("condyle_doors_" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path;
}

void write_scratch(const std::string& name, const std::string& bytes) {
  std::ofstream(scratch() / name, std::ios::binary | std::ios::trunc) << bytes;
}

}  // namespace condyle::fuzz
