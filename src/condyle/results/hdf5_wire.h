#pragma once

/// Questions and answers as bytes between two processes of one machine: of hdf5_process.cpp alone.

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <string>
#include <type_traits>
#include <vector>

#include "condyle/results/hdf5_question.h"

namespace condyle {

/// False from the first that could not be written on.
class WireWriter {
 public:
  explicit WireWriter(std::FILE* stream) : stream_(stream) {}
  void put(std::uint64_t number) { put(&number, sizeof number); }
  void put(const std::string& text) {
    put(text.size());
    put(text.data(), text.size());
  }
  template <typename Number>
  void put(const std::vector<Number>& numbers) {
    static_assert(std::is_arithmetic_v<Number>);
    put(numbers.size());
    put(numbers.data(), sizeof(Number) * numbers.size());
  }
  void put(const std::vector<std::string>& texts) {
    put(texts.size());
    for (const std::string& text : texts) put(text);
  }
  [[nodiscard]] bool flush() { return ok_ && std::fflush(stream_) == 0; }

 private:
  void put(const void* data, std::size_t size) {
    ok_ = ok_ && (size == 0 || std::fwrite(data, size, 1, stream_) == 1);
  }
  std::FILE* stream_;
  bool ok_ = true;
};

/// Takes no more bytes than it may: whoever sends them may have lost its wits. False from the first that was not there on.
class WireReader {
 public:
  WireReader(std::FILE* stream, double most) : stream_(stream), left_(most) {}
  void take(std::uint64_t& number) { take(&number, sizeof number); }
  void take(std::string& text) {
    if (const std::size_t size = announced(1); ok_) text.resize(size);
    take(text.data(), text.size());
  }
  template <typename Number>
  void take(std::vector<Number>& numbers) {
    static_assert(std::is_arithmetic_v<Number>);
    if (const std::size_t count = announced(sizeof(Number)); ok_) numbers.resize(count);
    take(numbers.data(), sizeof(Number) * numbers.size());
  }
  void take(std::vector<std::string>& texts) {
    const std::size_t count = announced(sizeof(std::string));
    for (std::size_t i = 0; i < count && ok_; ++i) take(texts.emplace_back());
  }
  [[nodiscard]] bool ok() const { return ok_; }

 private:
  /// How many parts of `size` bytes are to come.
  std::size_t announced(std::size_t size) {
    std::uint64_t count = 0;
    take(count);
    left_ -= static_cast<double>(size) * static_cast<double>(count);
    ok_ = ok_ && left_ >= 0;
    return ok_ ? count : 0;
  }
  void take(void* data, std::size_t size) {
    std::size_t got = 0;
    while (ok_ && got < size) {
      errno = 0;
      got += std::fread(static_cast<char*>(data) + got, 1, size - got, stream_);
      const bool interrupted = std::ferror(stream_) != 0 && errno == EINTR;
      if (interrupted) std::clearerr(stream_);
      ok_ = got == size || interrupted;
    }
  }
  std::FILE* stream_;
  double left_;  ///< [bytes]
  bool ok_ = true;
};

}  // namespace condyle
