// What is wrong with a command line, in one line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace causticl {

/// The message for `error`, which `app` threw: what is not understood, the name that may have been meant, and
/// where help is.
std::string command_line_fault(const CLI::ParseError& error, const CLI::App& app);

}  // namespace causticl
