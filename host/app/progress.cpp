#include "app/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/console.hpp"

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

std::string percentage(double fraction) {
  if (!std::isfinite(fraction)) return "unknown";
  const double percent = 100 * fraction;
  return formatted("%.*f%%", percent < 0.995 ? 2 : percent < 9.95 ? 1 : 0, percent);
}

std::string unknown_text(double fraction) {
  return percentage(fraction) +
         " of the pixels found no photon yet, though photons are stored around what they see: their error is "
         "unknown and counts as wrong; more passes, more photons or a larger renderer.radius find some";
}

namespace {

/// "error 6.1% → 2%": as estimated, and as wanted.
std::string error_part(const Progress& now) {
  std::string text = "error " + percentage(*now.error);
  if (now.wanted_error) text += formatted(" → %.3g%%", 100 * *now.wanted_error);
  return text;
}

/// In the order of their worth.
std::vector<std::string> progress_parts(const Progress& now) {
  const std::string elapsed = clock_time(now.seconds) + " elapsed";
  std::vector<std::string> parts;
  if (now.passes == 0) {
    // How many passes it takes nobody knows; what the error tells comes first.
    parts.push_back(formatted("pass %llu", static_cast<unsigned long long>(now.pass)));
    if (now.error) parts.push_back(error_part(now));
    if (std::isfinite(now.remaining)) parts.push_back("about " + clock_time(now.remaining) + " left");
    parts.push_back(elapsed);
    return parts;
  }
  parts = {formatted("pass %llu/%llu", static_cast<unsigned long long>(now.pass),
                     static_cast<unsigned long long>(now.passes)),
           elapsed, clock_time(now.remaining) + " left"};
  if (now.error)
    parts.push_back(error_part(now) +
                    (now.seconds_to_half ? ", half of it in " + clock_time(*now.seconds_to_half) : ""));
  return parts;
}

/// Of UTF-8: bytes that do not continue a character.
std::size_t columns(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

}  // namespace

std::string progress_text(const Progress& now, double photons_per_second, double rays_per_second, int width) {
  // Those at the end give way first.
  std::vector<std::string> parts = progress_parts(now);
  if (now.photons) parts.push_back(si_number(photons_per_second) + " photons/s");
  parts.push_back(si_number(rays_per_second) + " rays/s");

  std::string text;
  for (const auto& part : parts) {
    const std::string longer = text.empty() ? part : text + ", " + part;
    if (columns(longer) > static_cast<std::size_t>(width)) break;
    text = longer;
  }
  return text;
}

std::string progress_bar(const Progress& now, double photons_per_second, double rays_per_second, int width) {
  std::string text = progress_text(now, photons_per_second, rays_per_second, width);
  const int room = std::min(width - static_cast<int>(columns(text)) - 3, 40);
  if (room < 5) return text;
  double done = 0;
  if (now.passes > 0)
    done = static_cast<double>(now.pass) / static_cast<double>(now.passes);
  else if (std::isfinite(now.remaining))
    done = now.seconds / std::max(now.seconds + now.remaining, 1e-9);
  const auto filled = static_cast<std::size_t>(std::clamp(done, 0.0, 1.0) * room);
  std::string bar(static_cast<std::size_t>(room), '.');
  std::fill_n(bar.begin(), filled, '#');
  return "[" + bar + "] " + text;
}

ProgressReport::ProgressReport(std::FILE* stream, bool quiet)
    : stream_(stream), quiet_(quiet), terminal_(isatty(fileno(stream)) == 1) {}

ProgressReport::~ProgressReport() { clear_bar(); }

void ProgressReport::clear_bar() {
  if (bar_drawn_) causticl::clear_bar(stream_);
  bar_drawn_ = false;
}

void ProgressReport::note(const std::string& text) {
  if (quiet_ || text.empty() || !noted_.insert(text).second) return;
  clear_bar();
  print_message(stream_, "note: " + text);
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
  Progress start = first_;
  if (now.pass == first_.pass) {
    start = {};
    start.photons = now.photons_before;
    start.rays = now.rays_before;
  }
  const double seconds = std::max(now.seconds - start.seconds, 1e-9);
  const double photons = static_cast<double>(now.photons - start.photons) / seconds;
  const double rays = static_cast<double>(now.rays - start.rays) / seconds;
  if (terminal_) {
    // One column is left free: a full line would wrap on some terminals.
    draw_bar(stream_, progress_bar(now, photons, rays, terminal_width(stream_) - 1));
    bar_drawn_ = true;
  } else {
    print_message(stream_, progress_text(now, photons, rays, unlimited));
  }
}

void ProgressReport::finish(const std::vector<std::string>& files, const Statistics& statistics) {
  if (quiet_) return;
  clear_bar();
  std::string names;
  for (const auto& file : files) names += (names.empty() ? "" : ", ") + file;
  print_message(
      stream_,
      formatted("wrote %s: %llu %s in %.1f s (%s)", names.empty() ? "nothing" : names.c_str(),
                static_cast<unsigned long long>(statistics.passes),
                statistics.passes == 1 ? "pass" : "passes", statistics.seconds, reason(statistics.stop)));
  if (statistics.error) {
    const PictureError& error = *statistics.error;
    std::string line = "error unknown for " + percentage(statistics.confidence) + " of the pixels";
    if (std::isfinite(error.error))
      line = formatted("error %s or less in %s of the pixels (noise alone %s, bias alone %s)",
                       percentage(error.error).c_str(), percentage(statistics.confidence).c_str(),
                       percentage(error.noise).c_str(), percentage(error.bias).c_str());
    if (statistics.photons) line += ", " + si_number(static_cast<double>(statistics.photons)) + " photons";
    print_message(stream_, line);
    if (error.unknown > 0) print_message(stream_, "note: " + unknown_text(error.unknown));
  }
  for (const auto& warning : diagnostic_warnings(statistics.diagnostics))
    print_message(stream_, "warning: " + warning);
}

}  // namespace causticl
