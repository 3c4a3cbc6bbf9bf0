#include "app/option_binding.hpp"
#include "app/option_groups.hpp"

namespace causticl {

void add_merge_options(CLI::App& app, Options& options) {
  app.add_option("FILM", options.films, "parts of a render, as --film writes them, in any order")
      ->type_name("")
      ->required();
  app.add_option("-o,--output", options.render.outputs,
                 "image to write: .png (tone-mapped), .exr or .pfm (linear);\nmay be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_text(app, "--film", options.film, "FILE",
           "write the whole as a film, to go on from or to merge further");
  add_value(app, "--confidence", options.render.confidence,
            fraction_text("a share between 0 and 100%, as in 95% or 0.95", 1),
            "the share of pixels that the error is to hold for; 90% by\ndefault");
  add_switch(app, "--quiet", options.quiet, "print nothing but errors");
  add_device_options(app, options, options.render.threads, options.render.kernel_dir);
}

}  // namespace causticl
