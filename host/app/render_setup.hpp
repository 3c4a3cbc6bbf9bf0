// From the command line of `render` to what is rendered and where it goes.
#pragma once

#include <string>
#include <vector>

#include "app/options.hpp"

namespace causticl {

/// Puts the renderer options in place of the scene's own, and adds a notice to the scene for each one that
/// its integrator has no use for.
void apply_options(const Options& options, Scene& scene);

/// The files to write: those of -o, else that of scene_output().
std::vector<std::string> output_files(const Options& options, const Scene& scene);

/// Makes the folder of an output that the scene names. Throws UserError if an output or the statistics cannot
/// be written where the options or the scene say.
void check_outputs(const Options& options, const std::vector<std::string>& outputs);

/// What the user should know of --threads on this device; empty where it does what it says.
std::string threads_notice(const Options& options, const DeviceInfo& info);

}  // namespace causticl
