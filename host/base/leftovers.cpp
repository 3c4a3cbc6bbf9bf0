#include "base/leftovers.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <climits>
#include <cstdint>
#include <cstring>

namespace causticl {
namespace {

struct Slot {
  std::atomic<bool> used{false}, ready{false};
  char path[PATH_MAX];
};
Slot slots[16];

// What follows runs in a handler of signals: it may call the kernel and nothing else.

/// An entry as the kernel gives it.
struct DirectoryEntry {
  std::uint64_t inode;
  std::int64_t offset;
  unsigned short size;
  unsigned char type;
  char name[1];
};

void remove_tree(int parent, const char* name, int depth) {
  if (unlinkat(parent, name, 0) == 0 || depth > 16) return;
  const int folder = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0) return;
  alignas(DirectoryEntry) char buffer[2048];
  for (long size; (size = syscall(SYS_getdents64, folder, buffer, sizeof buffer)) > 0;)
    for (long at = 0; at < size;) {
      const auto* entry = reinterpret_cast<const DirectoryEntry*>(buffer + at);
      const char* child = buffer + at + offsetof(DirectoryEntry, name);
      at += entry->size;
      if (std::strcmp(child, ".") != 0 && std::strcmp(child, "..") != 0)
        remove_tree(folder, child, depth + 1);
    }
  close(folder);
  unlinkat(parent, name, AT_REMOVEDIR);
}

void remove_all_slots() {
  // A compiler on another thread may add a file meanwhile.
  for (int attempt = 0; attempt < 3; ++attempt)
    for (const Slot& slot : slots)
      if (slot.ready) remove_tree(AT_FDCWD, slot.path, 0);
}

void give_up(int) {
  constexpr char text[] =
      "causticl: error: the OpenCL driver gave up; what it said, if anything, stands above. Where memory or "
      "the "
      "address space (ulimit -v) is small, that is the cause\n";
  [[maybe_unused]] const auto ignored = write(STDERR_FILENO, text, sizeof text - 1);
  remove_all_slots();
  _exit(3);
}

/// Where nobody has asked for anything at this signal.
void handle(int signal_number, void (*handler)(int)) {
  struct sigaction action {};
  if (sigaction(signal_number, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) return;
  action.sa_handler = handler;
  action.sa_flags = 0;
  sigemptyset(&action.sa_mask);
  sigaction(signal_number, &action, nullptr);
}

}  // namespace

RemovedAtSignal::RemovedAtSignal(const std::string& folder) {
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP}) handle(signal_number, end_at_signal);
  for (int i = 0; i < 16 && folder.size() < sizeof slots[i].path; ++i) {
    if (slots[i].used.exchange(true)) continue;
    std::memcpy(slots[i].path, folder.c_str(), folder.size() + 1);
    slots[i].ready = true;
    slot_ = i;
    return;
  }
}

RemovedAtSignal::~RemovedAtSignal() {
  if (slot_ < 0) return;
  slots[slot_].ready = false;
  slots[slot_].used = false;
}

void end_at_signal(int signal_number) {
  remove_all_slots();
  signal(signal_number, SIG_DFL);
  raise(signal_number);
  // It is blocked until the handler returns, and ends the process then.
}

void expect_driver_to_abort() { handle(SIGABRT, give_up); }

}  // namespace causticl
