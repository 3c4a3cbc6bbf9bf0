// The one place that writes to standard output and standard error. All text passes through printable().
#pragma once

#include <cstdio>
#include <string>

namespace causticl {

/// Opens the standard descriptors that the caller closed, so that no file that is opened later takes their
/// place, and turns the signals of closed pipes and of files that grow too large into errors of write().
void console_start();

/// Lines on standard output. Throws UserError where they cannot be written; ends the process by SIGPIPE where
/// nobody reads them.
void print_output(const std::string& text);

/// "causticl: TEXT" as one line on `stream`, whose failure is nobody's concern.
void print_message(std::FILE* stream, const std::string& text);

/// A line of a terminal that the next bar, or clear_bar(), replaces.
void draw_bar(std::FILE* stream, const std::string& text);
void clear_bar(std::FILE* stream);

}  // namespace causticl
