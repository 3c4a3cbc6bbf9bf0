// Tasks that add tasks, on a few threads.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

namespace causticl {

class TaskPool {
 public:
  /// A task is told which thread it runs on, 0 to threads() - 1.
  using Task = std::function<void(unsigned thread)>;

  /// `threads` 0 takes all of the machine.
  explicit TaskPool(unsigned threads);
  unsigned threads() const { return threads_; }

  /// Adds a task, from anywhere.
  template <typename Callable>
  void add(Callable&& task) {
    // std::function wants a copyable callable; tasks carry their data by move.
    auto shared = std::make_shared<std::decay_t<Callable>>(std::forward<Callable>(task));
    push([shared](unsigned thread) { (*shared)(thread); });
  }

  /// Runs all tasks, and those that they add, to the end. Rethrows the first exception of a task.
  void run();

 private:
  unsigned threads_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Task> waiting_;
  unsigned running_ = 0;
  std::exception_ptr error_;

  void push(Task task);
  void work(unsigned thread);
};

/// Calls function(first, last) over chunks of [0, count) on `threads` threads.
void parallel_chunks(std::size_t count, std::size_t chunk, unsigned threads,
                     const std::function<void(std::size_t, std::size_t)>& function);

}  // namespace causticl
