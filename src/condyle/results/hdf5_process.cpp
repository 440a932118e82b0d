#include "condyle/results/hdf5_process.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <new>
#include <system_error>
#include <utility>

#include "condyle/results/hdf5_wire.h"

namespace condyle {
namespace {

enum Status : std::uint64_t { kAnswered = 0x68646635, kRefused, kNoMemory };

/// Results are compressed to a tenth at best, and are a few times as large in memory as on disk without it.
ChildLimits limits_of(const std::filesystem::path& file) {
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
  const double size = unknown ? 0 : static_cast<double>(bytes);
  return {.seconds = 5 + size / 1e6, .memory = 1e9 + 100 * size};
}

// ---- in the other process

bool put(const Hdf5Answer& answer, WireWriter& out) {
  out.put(kAnswered);
  out.put(answer.number);
  out.put(answer.texts);
  out.put(answer.shape);
  out.put(answer.values);
  return out.flush();
}

/// Of what `make` answers; false where nobody listens any more.
template <typename Make>
bool reply(std::FILE* stream, const Make& make) {
  WireWriter out(stream);
  try {
    return put(make(), out);
  } catch (const InputError& refused) {
    out.put(kRefused);
    out.put(std::string(refused.what()));
  } catch (const std::bad_alloc&) {
    out.put(kNoMemory);
  }
  return out.flush();
}

bool take(std::FILE* stream, Hdf5Question& question) {
  WireReader in(stream, 1e9);
  std::uint64_t kind = Hdf5Question::kKinds;
  in.take(kind);
  in.take(question.group);
  in.take(question.name);
  in.take(question.attribute);
  question.kind = static_cast<Hdf5Question::Kind>(kind);
  return in.ok() && kind < Hdf5Question::kKinds;
}

[[noreturn]] void serve(int socket,
                        const ChildLimits& limits,
                        const std::function<Hdf5Process::Answering()>& open) {
  confine(limits, socket);
  std::FILE *in = fdopen(socket, "r"), *out = fdopen(dup(socket), "w");
  try {
    Hdf5Process::Answering answer;
    bool heard = in != nullptr && out != nullptr && reply(out, [&] {
                   answer = open();
                   return Hdf5Answer();
                 });
    Hdf5Question question;
    while (heard && answer && take(in, question))
      heard = reply(out, [&] { return answer(question); });
  } catch (...) {  // nothing more is answered
  }
  _exit(0);
}

// ---- in this process

/// All of it, or false. Nobody may be there to read it.
bool send_all(int socket, const std::string& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t part = send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0) return false;
    sent += static_cast<std::size_t>(part);
  }
  return true;
}

void append(std::uint64_t number, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void append(const std::string& text, std::string& bytes) {
  append(text.size(), bytes);
  bytes += text;
}

std::string bytes_of(const Hdf5Question& question) {
  std::string bytes;
  append(static_cast<std::uint64_t>(question.kind), bytes);
  append(question.group, bytes);
  append(question.name, bytes);
  append(question.attribute, bytes);
  return bytes;
}

}  // namespace

Hdf5Process::Hdf5Process(const std::filesystem::path& file, const std::function<Answering()>& open)
    : name_(file.string()), limits_(limits_of(file)) {
  std::array<int, 2> sockets{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) == 0) {
    child_.of = getpid();
    child_.id = fork();
    if (child_.id == 0) {
      close(sockets[0]);
      serve(sockets[1], limits_, open);
    }
    close(sockets[1]);
    stream_.reset(fdopen(sockets[0], "r"));
    if (stream_ == nullptr) close(sockets[0]);
  }
  if (child_.id < 0 || stream_ == nullptr)
    throw InputError(name_ + ": cannot be read: no process for it, expected room for one");
  static_cast<void>(receive());  // that it is open
}

Hdf5Process::Child::~Child() {
  if (id <= 0 || getpid() != of) return;
  kill(id, SIGKILL);
  while (waitpid(id, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void Hdf5Process::damaged() const {
  throw DamagedFile(
      fmt::format("{}: is damaged, expected a run (HDF5) that can be read within {:.0f} s and "
                  "{:.0f} MB",
                  name_, limits_.seconds, limits_.memory / 1e6));
}

Hdf5Answer Hdf5Process::receive() {
  in_step_ = false;
  WireReader in(stream_.get(), limits_.memory);
  std::uint64_t status = 0;
  std::string refusal;
  Hdf5Answer answer;
  in.take(status);
  if (status == kRefused) in.take(refusal);
  if (status == kAnswered) {
    in.take(answer.number);
    in.take(answer.texts);
    in.take(answer.shape);
    in.take(answer.values);
  }
  in_step_ = in.ok();
  if (in.ok() && status == kNoMemory) throw std::bad_alloc();
  if (in.ok() && status == kRefused) throw InputError(refusal);
  if (!in.ok() || status != kAnswered) damaged();
  return answer;
}

Hdf5Answer Hdf5Process::ask(const Hdf5Question& question) {
  // Copies share its stream, and one could take the answer to another one's question.
  if (getpid() != child_.of)
    throw InputError(
        name_ + ": was opened by another process, expected to be read by the one that opened it");
  const std::lock_guard lock(mutex_);
  if (!in_step_ || !send_all(fileno(stream_.get()), bytes_of(question))) damaged();
  return receive();
}

}  // namespace condyle
