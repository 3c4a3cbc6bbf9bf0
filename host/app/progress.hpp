// What the user sees on stderr while a render runs.
#pragma once

#include <cstdio>
#include <set>
#include <string>
#include <vector>

#include "render/render.hpp"

namespace causticl {

/// "950", "12.3 k", "4.56 M": three figures and an SI prefix.
std::string si_number(double value);
/// "0:07", "12:34", "1:02:03".
std::string clock_time(double seconds);

/// "0.34%", "5.3%", "12%" for 0.00341, 0.053, 0.123.
std::string percentage(double fraction);

/// What the user should know where the error of such a fraction of the pixels is unknown.
std::string unknown_text(double fraction);

/// "pass 3/64, 0:07 elapsed, 2:20 left, error 5.3%, half of it in 9:40, 1.2 M photons/s, 9.8 M rays/s", or
/// "pass 12, error 6.1% → 2%, about 0:40 left, 0:07 elapsed, ..." where an error alone ends the render, in at
/// most `width` columns: what stands last is left out first where there is less room.
std::string progress_text(const Progress& now, double photons_per_second, double rays_per_second, int width);
/// The same with a bar in front of it, where there is room for one.
std::string progress_bar(const Progress& now, double photons_per_second, double rays_per_second, int width);

/// Notes and progress on a stream: one bar that is redrawn in place where the stream is a terminal, else a
/// line at passes 1, 2, 4, 8, ..., every ten seconds and at the end.
class ProgressReport {
 public:
  /// `quiet` prints nothing at all.
  ProgressReport(std::FILE* stream, bool quiet);
  ~ProgressReport();
  ProgressReport(const ProgressReport&) = delete;
  ProgressReport& operator=(const ProgressReport&) = delete;

  /// A line "causticl: note: TEXT"; each text once. Empty texts print nothing.
  void note(const std::string& text);
  void update(const Progress& now);
  /// Removes the bar and prints a line: the files written, the passes, the seconds and why it stopped; and
  /// one for each kind of fault that occurred.
  void finish(const std::vector<std::string>& files, const Statistics& statistics);

 private:
  std::FILE* stream_;
  bool quiet_, terminal_, bar_drawn_ = false;
  std::set<std::string> noted_;
  Progress first_, printed_;  // the first update, and the last that was printed
  void clear_bar();
};

}  // namespace causticl
