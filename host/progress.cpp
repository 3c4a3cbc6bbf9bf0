#include "progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace causticl {
namespace {

constexpr int unlimited = 1 << 20;                        // columns
constexpr double bar_interval = 0.1, line_interval = 10;  // seconds between two prints

template <typename... Arguments>
std::string formatted(const char* format, Arguments... arguments) {
  std::string text(static_cast<std::size_t>(std::snprintf(nullptr, 0, format, arguments...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, arguments...);
  return text;
}

int terminal_width(std::FILE* stream) {
  winsize size{};
  const bool known = ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

const char* reason(StopReason stop) {
  switch (stop) {
    case StopReason::time:
      return "time limit reached";
    case StopReason::error:
      return "error reached";
    case StopReason::interrupted:
      return "interrupted";
    case StopReason::passes:
      break;
  }
  return "done";
}

}  // namespace

std::string si_number(double value) {
  const char* const prefixes[] = {"", " k", " M", " G", " T", " P"};
  std::size_t prefix = 0;
  // 999.5 would be printed as 1000, or as 1e+03.
  while (value >= 999.5 && prefix + 1 < std::size(prefixes)) {
    value /= 1000;
    ++prefix;
  }
  const int decimals = prefix == 0 || value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2;
  return formatted("%.*f%s", decimals, value, prefixes[prefix]);
}

std::string clock_time(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return "?";
  const auto whole = std::llround(std::min(seconds, 1e12));
  if (whole < 3600) return formatted("%lld:%02lld", whole / 60, whole % 60);
  return formatted("%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string percentage(double share) {
  if (!std::isfinite(share)) return "unknown";
  const double percent = 100 * share;
  return formatted("%.*f%%", percent < 0.995 ? 2 : percent < 9.95 ? 1 : 0, percent);
}

std::string unknown_text(double share) {
  return percentage(share) +
         " of the pixels found no photon yet, though photons are stored around what they see: their error is "
         "unknown and counts as wrong; more passes, more photons or a larger renderer.radius find some";
}

std::string progress_text(const Progress& now, double photons_per_second, double rays_per_second, int width) {
  // In the order of their worth: those at the end give way first.
  std::vector<std::string> parts = {formatted("pass %llu/%llu", static_cast<unsigned long long>(now.pass),
                                              static_cast<unsigned long long>(now.passes)),
                                    clock_time(now.seconds) + " elapsed",
                                    clock_time(now.remaining) + " left"};
  if (now.error)
    parts.push_back("error " + percentage(*now.error) +
                    (now.seconds_to_half ? ", half of it in " + clock_time(*now.seconds_to_half) : ""));
  if (now.photons) parts.push_back(si_number(photons_per_second) + " photons/s");
  parts.push_back(si_number(rays_per_second) + " rays/s");

  std::string text;
  for (const auto& part : parts) {
    const std::string longer = text.empty() ? part : text + ", " + part;
    if (longer.size() > static_cast<std::size_t>(width)) break;
    text = longer;
  }
  return text;
}

std::string progress_bar(const Progress& now, double photons_per_second, double rays_per_second, int width) {
  std::string text = progress_text(now, photons_per_second, rays_per_second, width);
  const int room = std::min(width - static_cast<int>(text.size()) - 3, 40);
  if (room < 5) return text;
  const double share = now.passes ? static_cast<double>(now.pass) / static_cast<double>(now.passes) : 0;
  const auto filled = static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * room);
  std::string bar(static_cast<std::size_t>(room), '.');
  std::fill_n(bar.begin(), filled, '#');
  return "[" + bar + "] " + text;
}

ProgressReport::ProgressReport(std::FILE* stream, bool quiet)
    : stream_(stream), quiet_(quiet), terminal_(isatty(fileno(stream)) == 1) {}

ProgressReport::~ProgressReport() { clear_bar(); }

void ProgressReport::clear_bar() {
  if (bar_drawn_) std::fputs("\r\033[K", stream_);
  bar_drawn_ = false;
}

void ProgressReport::note(const std::string& text) {
  if (quiet_ || text.empty() || !noted_.insert(text).second) return;
  clear_bar();
  std::fprintf(stream_, "causticl: note: %s\n", text.c_str());
}

void ProgressReport::update(const Progress& now) {
  if (quiet_) return;
  const bool is_first = first_.pass == 0, is_last = now.pass == now.passes;
  if (is_first) first_ = now;
  const double since_print = now.seconds - printed_.seconds;
  const bool due = is_first || is_last ||
                   (terminal_ ? since_print >= bar_interval
                              : since_print >= line_interval || std::has_single_bit(now.pass));
  if (!due) return;
  printed_ = now;

  // Start-up (kernels, tree) is left out of the rates as soon as two passes can be told from it.
  const Progress start = now.pass > first_.pass ? first_ : Progress{};
  const double seconds = std::max(now.seconds - start.seconds, 1e-9);
  const double photons = static_cast<double>(now.photons - start.photons) / seconds;
  const double rays = static_cast<double>(now.rays - start.rays) / seconds;
  if (terminal_) {
    // One column is left free: a full line would wrap on some terminals.
    std::fprintf(stream_, "\r%s\033[K",
                 progress_bar(now, photons, rays, terminal_width(stream_) - 1).c_str());
    bar_drawn_ = true;
  } else {
    std::fprintf(stream_, "causticl: %s\n", progress_text(now, photons, rays, unlimited).c_str());
  }
  std::fflush(stream_);
}

void ProgressReport::finish(const std::vector<std::string>& files, const Statistics& statistics) {
  if (quiet_) return;
  clear_bar();
  std::string names;
  for (const auto& file : files) names += (names.empty() ? "" : ", ") + file;
  std::fprintf(stream_, "causticl: wrote %s: %llu %s in %.1f s (%s)\n", names.c_str(),
               static_cast<unsigned long long>(statistics.passes), statistics.passes == 1 ? "pass" : "passes",
               statistics.seconds, reason(statistics.stop));
  if (statistics.error) {
    const PictureError& error = *statistics.error;
    std::string bound = "unknown for " + percentage(statistics.confidence) + " of the pixels";
    if (std::isfinite(error.error))
      bound = percentage(error.error) + " or less in " + percentage(statistics.confidence) +
              " of the pixels (noise alone " + percentage(error.noise) + ", bias alone " +
              percentage(error.bias) + ")";
    std::fprintf(stream_, "causticl: error %s", bound.c_str());
    if (statistics.photons)
      std::fprintf(stream_, ", %s photons", si_number(static_cast<double>(statistics.photons)).c_str());
    std::fputs("\n", stream_);
    if (error.unknown > 0) std::fprintf(stream_, "causticl: note: %s\n", unknown_text(error.unknown).c_str());
  }
  for (const auto& warning : fault_warnings(statistics.faults))
    std::fprintf(stream_, "causticl: warning: %s\n", warning.c_str());
  std::fflush(stream_);
}

}  // namespace causticl
