// The kernel files that travel inside the binary.
#pragma once

#include <map>
#include <string>

namespace causticl {

/// Path in cl/ ("photons/grid.cl") to text, of every file in cl/ when the binary was built.
const std::map<std::string, std::string>& embedded_kernel_sources();

/// The text of `file` with every #include "name" replaced once by that file (each file at most once, as with
/// include guards) and #line directives, so that messages name the right place. "FOLDER/*.cl" stands for
/// every file of the folder, in order. Reads `kernel_dir` live where it is not empty, else the embedded
/// files. Throws UserError for a file that is not there.
std::string flatten_kernel_source(const std::string& file, const std::string& kernel_dir = "");

/// The same for a text that is not a file of cl/ (the tests' small kernels).
std::string flatten_kernel_text(const std::string& text, const std::string& kernel_dir = "");

}  // namespace causticl
