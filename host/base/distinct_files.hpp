// Whether files that a command reads and writes are different ones.
#pragma once

#include <string>
#include <vector>

namespace causticl {

/// A file, and what a command has it for, as in "the film".
struct NamedFile {
  std::string purpose, file;
};

/// Throws UserError where two of these for different purposes are one file, by whatever names and links.
/// Empty names are none; devices and pipes may be named more than once.
void check_distinct(const std::vector<NamedFile>& files);

}  // namespace causticl
