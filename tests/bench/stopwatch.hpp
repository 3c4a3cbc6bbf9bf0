// Time by the clock and on the processors.
#pragma once

#include <chrono>
#include <ctime>

namespace causticl {

struct Elapsed {
  double wall = 0, cpu = 0;  // seconds; cpu: of all threads of this process
};

class Stopwatch {
 public:
  Elapsed elapsed() const {
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count(),
            static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC};
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  std::clock_t cpu_ = std::clock();
};

}  // namespace causticl
