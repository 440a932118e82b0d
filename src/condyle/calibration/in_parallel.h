#pragma once

/// Independent tasks on all cores, and the word to stop them.

#include <atomic>
#include <functional>
#include <mutex>
#include <string>

namespace condyle {

/// Told of how far a stage is, from any thread; false: stop, and it stays so.
class StudyProgress {
 public:
  using Tell = std::function<bool(const std::string& stage, int done, int total)>;
  explicit StudyProgress(Tell tell) : tell_(std::move(tell)) {}

  bool operator()(const std::string& stage, int done, int total);
  /// The same numbers once more, so that a word to stop is heard within a long task.
  bool goes_on();
  [[nodiscard]] bool stopped() const { return stopped_; }

 private:
  bool tell_now();

  Tell tell_;
  std::mutex one_at_a_time_;
  std::string stage_;
  int done_ = 0, total_ = 0;
  std::atomic<bool> stopped_ = false;
};

/// Calls task(k) for k = 0 to tasks - 1; each thread has a task of its own with what it works on, made
/// by make_task one after the other on the calling thread. What task(k) leaves behind has to depend on
/// k alone. threads 0: as many as there are cores. The first exception is rethrown. False: stopped, and
/// not all were begun.
bool in_parallel(const std::string& stage,
                 int tasks,
                 int threads,
                 const std::function<std::function<void(int)>()>& make_task,
                 StudyProgress& progress);

}  // namespace condyle
