// A run of `causticl` with what it cost, and with limits.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <string>
#include <vector>

namespace causticl {

struct MeasuredRun {
  int exit_code = -1, signal = 0;
  std::string errors;
  long peak_kilobytes = 0;
  double cpu_seconds = 0;
};

/// Runs `causticl` in `folder` after `prepare` was called in the new process.
inline MeasuredRun run_measured(const std::vector<std::string>& arguments, const std::string& folder,
                                const std::function<void()>& prepare = {}) {
  std::vector<std::string> words{CAUSTICL_BINARY};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  int errors[2];
  if (pipe2(errors, O_CLOEXEC) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    dup2(errors[1], STDERR_FILENO);
    dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDOUT_FILENO);
    if (prepare) prepare();
    if (chdir(folder.c_str()) == 0) execv(argv[0], argv.data());
    _exit(127);
  }
  close(errors[1]);
  MeasuredRun result;
  char bytes[4096];
  for (ssize_t count; (count = read(errors[0], bytes, sizeof bytes)) > 0;)
    result.errors.append(bytes, static_cast<std::size_t>(count));
  close(errors[0]);
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  result.peak_kilobytes = usage.ru_maxrss;
  const auto seconds = [](const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
  result.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  return result;
}

}  // namespace causticl
