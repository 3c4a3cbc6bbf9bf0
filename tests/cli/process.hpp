// Running the real binary: its exit code, what it printed, signals, and a terminal where one is wanted.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace causticl {

struct Finished {
  int exit_code = -1;  // -1 where a signal ended it
  int signal = 0;      // that ended it
  std::string output, errors;
  double seconds = 0;
};

/// `causticl` with these arguments, started in `folder`. On a pipe, standard output and errors come apart; on
/// a terminal (of `columns` columns) all is in `errors`.
class Process {
 public:
  enum class Stream { pipe, terminal };

  Process(const std::vector<std::string>& arguments, const std::string& folder, Stream stream = Stream::pipe,
          const std::vector<std::pair<std::string, std::string>>& environment = {}, unsigned columns = 120) {
    // All memory is taken before the fork: other threads may hold locks of the heap then.
    std::vector<std::string> words{CAUSTICL_BINARY};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    int out[2] = {-1, -1}, err[2] = {-1, -1};
    if (stream == Stream::pipe) {
      if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
      child_ = fork();
    } else {
      const winsize size{24, static_cast<unsigned short>(columns), 0, 0};
      child_ = forkpty(&err[0], nullptr, nullptr, &size);
    }
    if (child_ < 0) throw std::runtime_error("no process");
    if (child_ == 0) {
      if (stream == Stream::pipe) {
        dup2(out[1], STDOUT_FILENO);
        dup2(err[1], STDERR_FILENO);
      }
      for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
      if (chdir(folder.c_str()) == 0) execv(argv[0], argv.data());
      _exit(127);
    }
    if (stream == Stream::pipe) {
      close(out[1]);
      close(err[1]);
    }
    sources_ = {Source{out[0], {}}, Source{err[0], {}}};
  }

  ~Process() {
    for (auto& source : sources_)
      if (source.descriptor >= 0) close(source.descriptor);
    if (child_ > 0) {
      ::kill(child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Waits until `text` stands in what was printed to standard error.
  void wait_for(const std::string& text) {
    while (sources_[1].text.find(text) == std::string::npos) {
      if (!read_some())
        throw std::runtime_error("causticl ended without '" + text + "', but: " + sources_[1].text);
    }
  }

  void send(int signal_number) { ::kill(child_, signal_number); }

  Finished wait() {
    while (read_some()) {
    }
    int status = 0;
    while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    Finished result;
    if (WIFEXITED(status)) result.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
    result.output = sources_[0].text;
    result.errors = sources_[1].text;
    result.seconds = seconds();
    return result;
  }

 private:
  struct Source {
    int descriptor = -1;
    std::string text;
  };
  // Seconds; then it counts as hung. Kernels that are compiled anew on a busy machine take a minute.
  static constexpr double longest = 300;

  pid_t child_ = -1;
  std::array<Source, 2> sources_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  /// Takes what there is; false at the end of both streams.
  bool read_some() {
    std::array<pollfd, 2> waiting{};
    for (std::size_t i = 0; i < 2; ++i) waiting[i] = {sources_[i].descriptor, POLLIN, 0};
    if (sources_[0].descriptor < 0 && sources_[1].descriptor < 0) return false;
    if (seconds() > longest) throw std::runtime_error("causticl hangs; it said: " + sources_[1].text);
    poll(waiting.data(), waiting.size(), 200);
    for (std::size_t i = 0; i < 2; ++i) {
      if (!(waiting[i].revents & (POLLIN | POLLHUP | POLLERR))) continue;
      std::array<char, 4096> bytes;
      const ssize_t count = read(sources_[i].descriptor, bytes.data(), bytes.size());
      if (count > 0) {
        sources_[i].text.append(bytes.data(), static_cast<std::size_t>(count));
      } else if (count == 0 || errno != EINTR) {  // a terminal ends with EIO
        close(sources_[i].descriptor);
        sources_[i].descriptor = -1;
      }
    }
    return true;
  }
};

/// Runs `causticl` to its end.
inline Finished run_causticl(const std::vector<std::string>& arguments, const std::string& folder,
                             const std::vector<std::pair<std::string, std::string>>& environment = {}) {
  return Process(arguments, folder, Process::Stream::pipe, environment).wait();
}

}  // namespace causticl
