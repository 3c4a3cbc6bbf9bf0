#include "app/option_checks.hpp"
#include "app/option_groups.hpp"

namespace causticl {

void add_image_options(CLI::App& app, Options& options) {
  app.add_option_function<std::string>(
         "--max-image-memory",
         [&options](const std::string& text) {
           options.scene_options.image_limits = {*parse_bytes(text), true};
         },
         "that all images take together, decoded at 16 bytes a pixel;\ndefault: 4G, and then also no more "
         "than 128 "
         "pixels for each\nbyte of a file, where it holds more than 8 million")
      ->check(expect("a size from 1 to 1024T, as in 512M or 4G", is_bytes))
      ->type_name("SIZE");
}

}  // namespace causticl
