#include "condyle/mesh_files/isolated_import.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <exception>
#include <limits>
#include <mutex>
#include <vector>

#include <fmt/format.h>

#include "condyle/input_error.h"
#include "condyle/mesh_files/assimp_import.h"
#include "condyle/mesh_files/mesh_bytes.h"

namespace condyle {
namespace {

// What comes through the pipe: this, then either a reason or coordinates and corners.
struct Answer {
  std::uint32_t mark = 0;
  std::uint32_t reason = 0;       ///< bytes; 0 where the file was read
  std::uint64_t coordinates = 0;  ///< numbers of 4 bytes
  std::uint64_t corners = 0;
};
constexpr std::uint32_t kMark = 0x6d657368;

// ---- in the child

void send(int pipe, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t sent = write(pipe, at, size);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) _exit(1);
    at += sent;
    size -= static_cast<std::size_t>(sent);
  }
}

[[noreturn]] void answer(int pipe, const std::filesystem::path& file, const ChildLimits& limits) {
  confine(limits, pipe);
  Answer head{.mark = kMark};
  try {
    const ImportedMesh mesh = import_with_assimp(file.string());
    head.coordinates = mesh.coordinates.size();
    head.corners = mesh.corners.size();
    send(pipe, &head, sizeof head);
    send(pipe, mesh.coordinates.data(), 4 * mesh.coordinates.size());
    send(pipe, mesh.corners.data(), 4 * mesh.corners.size());
  } catch (const std::exception& error) {
    const std::string reason = quotable(error.what());
    head.reason = static_cast<std::uint32_t>(reason.size());
    send(pipe, &head, sizeof head);
    send(pipe, reason.data(), reason.size());
  }
  _exit(0);
}

// ---- in this process

/// The child and the end of the pipe that it writes to.
class Child {
 public:
  Child(const std::filesystem::path& file, const ChildLimits& limits)
      : deadline_(std::chrono::steady_clock::now() +
                  std::chrono::milliseconds(static_cast<long>(2000 * limits.seconds))) {
    // Another child must not hold this pipe open.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
      error_ = errno;
      return;
    }
    id_ = fork();
    if (id_ == 0) answer(ends[1], file, limits);
    if (id_ < 0) error_ = errno;
    close(ends[1]);
    pipe_ = ends[0];
  }
  ~Child() {
    if (pipe_ >= 0) close(pipe_);
    if (id_ <= 0) return;
    kill(id_, SIGKILL);
    while (waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// That of the system where there is no child; else 0.
  [[nodiscard]] int error() const { return error_; }
  /// Fills the buffer; false where the child ends, or the clock runs out, before it is full.
  bool receive(void* data, std::size_t size) {
    char* at = static_cast<char*>(data);
    while (size > 0) {
      if (!wait_for_data()) return false;
      const ssize_t got = read(pipe_, at, size);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      at += got;
      size -= static_cast<std::size_t>(got);
    }
    return true;
  }

  template <class T>
  bool receive(std::vector<T>& values, std::uint64_t count) {
    if (count > std::numeric_limits<int>::max()) return false;
    values.resize(count);
    return receive(values.data(), sizeof(T) * values.size());
  }

 private:
  bool wait_for_data() {
    while (id_ > 0) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
          deadline_ - std::chrono::steady_clock::now());
      if (left.count() <= 0) return false;
      pollfd entry{pipe_, POLLIN, 0};
      const int ready = poll(&entry, 1, static_cast<int>(std::min<long>(left.count(), 1000)));
      if (ready > 0) return true;
      if (ready < 0 && errno != EINTR) return false;
    }
    return false;
  }

  std::chrono::steady_clock::time_point deadline_;
  pid_t id_ = -1;
  int pipe_ = -1;
  int error_ = 0;
};

TriangleMesh to_mesh(const std::vector<float>& coordinates, const std::vector<int>& corners) {
  TriangleMesh mesh;
  mesh.vertices.reserve(coordinates.size() / 3);
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
    mesh.vertices.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  mesh.triangles.reserve(corners.size() / 3);
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
    mesh.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  return mesh;
}

/// The child may have lost its wits before it answered: nothing it says is taken on trust.
bool is_sound(const TriangleMesh& mesh) {
  const int n = static_cast<int>(mesh.vertices.size());
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [n](const auto& triangle) {
    return std::all_of(triangle.begin(), triangle.end(), [n](int v) { return v >= 0 && v < n; });
  });
}

}  // namespace

bool importer_knows(const std::string& ending) { return assimp_knows(ending); }

TriangleMesh import_isolated(const std::filesystem::path& file, const ChildLimits& limits) {
  const auto fail = [&file](const std::string& what) {
    throw InputError(fmt::format("{}: mesh cannot be read: {}", file.string(), what));
  };
  Child child(file, limits);
  if (child.error() != 0)
    fail(fmt::format("no process can be started for it: {}", std::strerror(child.error())));
  Answer head;
  const bool answered = child.receive(&head, sizeof head) && head.mark == kMark;
  if (answered && head.reason > 0) {
    std::vector<char> reason;
    if (child.receive(reason, head.reason)) fail(quotable({reason.data(), reason.size()}));
  }
  std::vector<float> coordinates;
  std::vector<int> corners;
  const bool whole = answered && head.reason == 0 && child.receive(coordinates, head.coordinates) &&
                     child.receive(corners, head.corners);
  TriangleMesh mesh = to_mesh(coordinates, corners);
  if (!whole || !is_sound(mesh))
    fail(
        fmt::format("the importer stopped on it, expected a file that it reads within {:.0f} s "
                    "and {:.0f} MB",
                    limits.seconds, limits.memory / 1e6));
  return mesh;
}

}  // namespace condyle
