// Which files a scene may have read for it.
#pragma once

#include <filesystem>
#include <string>

#include "base/source_location.hpp"

namespace causticl {

/// A file that a scene names, and where it does so.
struct AssetName {
  std::string name;
  SourceLocation where;
};

/// What keeps an existing file from being an asset: it is a pipe, a socket, a device, or the kernel's own
/// (/proc, /sys). Empty where nothing does. Opens it without waiting for anything, and without any effect on
/// it.
std::string asset_fault(const std::filesystem::path& file);

}  // namespace causticl
