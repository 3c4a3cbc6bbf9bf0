#include "selftest/selftest_processes.hpp"

#include <poll.h>
#include <signal.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "base/error.hpp"

namespace causticl {
namespace {

/// More would wait for each other's groups, and each holds what its checks need of memory.
constexpr unsigned most_processes = 4;

/// Whole buffers through a pipe; false where the other end is closed.
bool write_all(int pipe, const void* data, std::size_t size) {
  for (const char* from = static_cast<const char*>(data); size > 0;) {
    const ssize_t written = ::write(pipe, from, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    from += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}
bool read_all(int pipe, void* data, std::size_t size) {
  for (char* to = static_cast<char*>(data); size > 0;) {
    const ssize_t got = ::read(pipe, to, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    to += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

using NumberedResult = SelftestProcesses::NumberedResult;

/// A result on its way through a pipe, with the number of its check: MessagePack, which knows infinity and
/// NaN, after its length.
bool send(int pipe, std::size_t check, const CheckResult& r) {
  const auto bytes = nlohmann::json::to_msgpack({check, r.inputs, r.failures, r.worst_error, r.tolerance,
                                                 r.unit, r.example, r.note, r.skipped, r.seconds});
  const std::size_t size = bytes.size();
  return write_all(pipe, &size, sizeof size) && write_all(pipe, bytes.data(), size);
}
std::optional<NumberedResult> receive(int pipe) {
  std::size_t size = 0;
  if (!read_all(pipe, &size, sizeof size)) return {};
  std::vector<std::uint8_t> bytes(size);
  if (!read_all(pipe, bytes.data(), size)) return {};
  const auto row = nlohmann::json::from_msgpack(bytes);
  return NumberedResult{row[0].get<std::size_t>(),
                        CheckResult{row[1], row[2], row[3], row[4], row[5], row[6], row[7], row[8], row[9]}};
}

/// The next group that nobody has taken: each byte of the pipe has one reader.
std::optional<std::size_t> take_group(int groups) {
  std::uint8_t group = 0;
  return read_all(groups, &group, 1) ? std::optional<std::size_t>(group) : std::nullopt;
}

void close_if_open(int& descriptor) {
  if (descriptor >= 0) close(descriptor);
  descriptor = -1;
}

void make_pipe(int& in, int& out) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe for the processes of selftest");
  out = ends[0];
  in = ends[1];
}

}  // namespace

SelftestProcesses::SelftestProcesses(std::vector<Check> checks, SelftestOptions options,
                                     const std::string& device, bool keep_kernels)
    : checks_(std::move(checks)), options_(std::move(options)) {
  for (std::size_t i = 0; i < checks_.size(); ++i) {
    const auto group = std::find_if(groups_.begin(), groups_.end(), [&](const auto& members) {
      return checks_[members[0]].programs == checks_[i].programs;
    });
    if (group == groups_.end())
      groups_.push_back({i});
    else
      group->push_back(i);
  }
  // Who limits the threads means all of them, and one input or one group is for one process.
  if (options_.threads > 0 || !options_.replay.empty()) return;
  const std::size_t processes = std::min<std::size_t>(
      {most_processes, std::max(std::thread::hardware_concurrency(), 1u), groups_.size(), 255});
  make_pipe(groups_in_, groups_out_);
  while (helpers_.size() + 1 < processes) {
    int in = -1, out = -1;
    make_pipe(in, out);
    const pid_t process = fork();
    if (process == 0) {
      close(out);
      close_if_open(groups_in_);
      for (const auto& other : helpers_) close(other.rows);
      help(device, keep_kernels, in);
    }
    close(in);
    if (process < 0) {  // no room for more: those that there are, or none, do it all
      close(out);
      break;
    }
    helpers_.push_back({process, out});
  }
}

SelftestProcesses::~SelftestProcesses() {
  close_if_open(groups_in_);
  close_if_open(groups_out_);
  for (const auto& helper : helpers_) {
    kill(helper.process, SIGTERM);  // it may be in the middle of a check that nobody waits for any more
    end(helper);
  }
}

void SelftestProcesses::end(const Helper& helper) {
  close(helper.rows);
  while (waitpid(helper.process, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void SelftestProcesses::help(const std::string& spec, bool keep_kernels, int rows) const {
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // a kernel that does not end shall not outlive who asked for it
#endif
  try {
    // Made with the first group: a device that needs no helpers gives them none.
    std::optional<KernelCache> kernels;
    std::optional<Device> device;
    while (const auto group = take_group(groups_out_)) {
      if (!device) {
        kernels.emplace(keep_kernels);
        device.emplace(find_device(spec), 0, &*kernels);
      }
      for (const std::size_t i : groups_[*group])
        if (!send(rows, i, run_check(*device, checks_[i], options_).result)) _exit(1);
    }
  } catch (...) {
    _exit(1);  // the first process finds the same fault, and has the words for it
  }
  _exit(0);
}

std::optional<NumberedResult> SelftestProcesses::receive_any(int milliseconds) {
  while (!helpers_.empty()) {
    std::vector<pollfd> waiting;
    for (const auto& helper : helpers_) waiting.push_back({helper.rows, POLLIN, 0});
    if (poll(waiting.data(), waiting.size(), milliseconds) == 0) return {};
    for (std::size_t h = 0; h < waiting.size(); ++h) {
      if (!(waiting[h].revents & (POLLIN | POLLHUP | POLLERR))) continue;
      if (auto row = receive(helpers_[h].rows)) return row;
      end(helpers_[h]);
      helpers_.erase(helpers_.begin() + static_cast<std::ptrdiff_t>(h));
      break;
    }
  }
  return {};
}

std::vector<SelftestRow> SelftestProcesses::run(Device& device,
                                                const std::function<void(const SelftestRow&)>& report) {
  std::vector<std::optional<CheckResult>> results(checks_.size());
  std::vector<SelftestRow> rows;
  const auto put = [&](std::size_t check, CheckResult result) {
    results[check] = std::move(result);
    while (rows.size() < checks_.size() && results[rows.size()]) {
      rows.push_back({checks_[rows.size()], *results[rows.size()]});
      if (report) report(rows.back());
    }
  };
  const auto run_here = [&](std::size_t check) {
    put(check, run_check(device, checks_[check], options_).result);
  };
  if (!helpers_.empty() && !device.compiles_in_parallel()) {
    std::vector<std::uint8_t> numbers(groups_.size());
    for (std::size_t g = 0; g < numbers.size(); ++g) numbers[g] = static_cast<std::uint8_t>(g);
    // The largest groups first, so that no process is left with one at the end.
    std::stable_sort(numbers.begin(), numbers.end(),
                     [&](std::uint8_t a, std::uint8_t b) { return groups_[a].size() > groups_[b].size(); });
    write_all(groups_in_, numbers.data(), numbers.size());
    close_if_open(groups_in_);
    while (const auto group = take_group(groups_out_))
      for (const std::size_t i : groups_[*group]) {
        run_here(i);
        while (auto row = receive_any(0)) put(row->first, std::move(row->second));
      }
    while (auto row = receive_any(-1)) put(row->first, std::move(row->second));
  }
  for (std::size_t i = 0; i < checks_.size(); ++i)
    if (!results[i]) run_here(i);
  return rows;
}

}  // namespace causticl
