#include "base/task_pool.hpp"

#include <algorithm>
#include <thread>
#include <utility>

namespace causticl {

TaskPool::TaskPool(unsigned threads)
    : threads_(threads ? threads : std::max(1u, std::thread::hardware_concurrency())) {}

void TaskPool::push(Task task) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(task));
  }
  changed_.notify_one();
}

void TaskPool::run() {
  std::vector<std::jthread> others;
  for (unsigned thread = 1; thread < threads_; ++thread)
    others.emplace_back([this, thread] { work(thread); });
  work(0);
  others.clear();
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void TaskPool::work(unsigned thread) {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return !waiting_.empty() || running_ == 0; });
    if (waiting_.empty()) return;
    Task task = std::move(waiting_.back());
    waiting_.pop_back();
    ++running_;
    lock.unlock();
    try {
      task(thread);
    } catch (...) {
      const std::lock_guard guard(mutex_);
      if (!error_) error_ = std::current_exception();
      waiting_.clear();
    }
    task = nullptr;
    lock.lock();
    if (--running_ == 0 && waiting_.empty()) changed_.notify_all();
  }
}

void parallel_chunks(std::size_t count, std::size_t chunk, unsigned threads,
                     const std::function<void(std::size_t, std::size_t)>& function) {
  TaskPool pool(count <= chunk ? 1 : threads);
  for (std::size_t first = 0; first < count; first += chunk)
    pool.add([&function, first, last = std::min(first + chunk, count)](unsigned) { function(first, last); });
  pool.run();
}

}  // namespace causticl
