#include "condyle/calibration/in_parallel.h"

#include <algorithm>
#include <exception>
#include <thread>
#include <vector>

#include "condyle/start_threads.h"

namespace condyle {

bool StudyProgress::tell_now() {
  if (!stopped_ && tell_ && !tell_(stage_, done_, total_)) stopped_ = true;
  return !stopped_;
}

bool StudyProgress::operator()(const std::string& stage, int done, int total) {
  const std::lock_guard lock(one_at_a_time_);
  stage_ = stage;
  done_ = done;
  total_ = total;
  return tell_now();
}

bool StudyProgress::goes_on() {
  const std::lock_guard lock(one_at_a_time_);
  return tell_now();
}

bool in_parallel(const std::string& stage,
                 int tasks,
                 int threads,
                 const std::function<std::function<void(int)>()>& make_task,
                 StudyProgress& progress) {
  threads = std::min(thread_count(threads), tasks);
  if (tasks == 0 || !progress(stage, 0, tasks)) return tasks == 0;
  std::vector<std::function<void(int)>> own;
  for (int t = 0; t < threads; ++t) own.push_back(make_task());

  std::vector<std::exception_ptr> errors(static_cast<std::size_t>(tasks));
  std::atomic<int> next = 0, done = 0;
  std::atomic<bool> failed = false;
  const auto work = [&](const std::function<void(int)>& task) {
    for (int k = next++; k < tasks && !progress.stopped() && !failed; k = next++) {
      try {
        task(k);
        progress(stage, ++done, tasks);
      } catch (...) {
        errors[static_cast<std::size_t>(k)] = std::current_exception();
        failed = true;
      }
    }
  };
  {
    const auto others =
        start_threads(1, threads, [&](int t) { work(own[static_cast<std::size_t>(t)]); });
    work(own.front());
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return done == tasks && !progress.stopped();
}

}  // namespace condyle
