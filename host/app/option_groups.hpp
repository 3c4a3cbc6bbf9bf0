// Groups of options, a file each.
#pragma once

#include <CLI/CLI.hpp>

#include "app/options.hpp"

namespace causticl {

/// The scene and what changes it as it is read.
void add_scene_options(CLI::App& app, Options& options);

/// What `render` renders, where the picture goes and for how long.
void add_render_options(CLI::App& app, Options& options);

/// What a command runs on; a selftest has settings of its own for threads and kernels.
void add_device_options(CLI::App& app, Options& options, unsigned& threads, std::string& kernel_dir,
                        bool takes_several = false);

/// What `merge` puts together, and where that goes.
void add_merge_options(CLI::App& app, Options& options);

/// Which checks `selftest` runs, on what.
void add_selftest_options(CLI::App& app, Options& options);

/// What `study` measures, for how long and where it goes.
void add_study_options(CLI::App& app, Options& options);

/// What the images that a command reads may cost.
void add_image_options(CLI::App& app, Options& options);

}  // namespace causticl
