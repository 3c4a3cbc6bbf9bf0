// Groups of options that one command alone has, and that fill a file.
#pragma once

#include <CLI/CLI.hpp>

#include "app/options.hpp"

namespace causticl {

/// Which checks `selftest` runs, on what.
void add_selftest_options(CLI::App& app, Options& options);

/// What `study` measures, for how long and where it goes.
void add_study_options(CLI::App& app, Options& options);

/// What the images that a command reads may cost.
void add_image_options(CLI::App& app, Options& options);

}  // namespace causticl
