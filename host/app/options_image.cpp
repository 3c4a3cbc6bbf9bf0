#include "app/option_binding.hpp"
#include "app/option_groups.hpp"

namespace causticl {

void add_image_options(CLI::App& app, Options& options) {
  add_value(app, "--max-image-memory", options.scene_options.image_limits, image_memory_text(),
            "that all images take together, decoded at 16 bytes a pixel;\ndefault: 4G, and then also no more "
            "than 128 pixels for each\nbyte of a file, where it holds more than 8 million");
}

}  // namespace causticl
