// What a study was measured of: every byte that its numbers depend on.
#pragma once

#include <string>
#include <vector>

#include "study/study.hpp"

namespace causticl {

/// A hash of `bytes` after what has the hash `before`, as text.
std::string content_hash(const std::string& bytes, const std::string& before = "");

/// The hash of a file's bytes. Throws UserError.
std::string file_hash(const std::string& file);

/// The hash of the scene's file and of every file that it names, names included.
std::string scene_hash_of(const Scene& scene);

/// The hash of every kernel file: those of --kernel-dir, or those in the binary.
std::string kernels_hash(const std::string& kernel_dir);

/// The options of `study` that decide what is rendered, as words of the command line, and the hash of the
/// kernels' sources. Not those that only decide for how long and what is printed.
std::vector<std::string> deciding_options(const StudyRequest& request);

}  // namespace causticl
