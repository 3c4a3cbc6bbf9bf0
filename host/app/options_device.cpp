#include "app/option_binding.hpp"
#include "app/option_groups.hpp"

namespace causticl {

void add_device_options(CLI::App& app, Options& options, unsigned& threads, std::string& kernel_dir,
                        bool takes_several) {
  const std::string several =
      "; several\nwith commas between them, or all, share every pass, to\nthe same picture";
  add_text(app, "--device", options.device, "SPEC",
           "index, cpu, gpu or part of a name (see `causticl devices`)" +
               (takes_several ? several : std::string()) +
               ";\ndefault: the first GPU, else the first device");
  add_value(app, "--threads", threads, whole_number<unsigned>(1, largest_int),
            "compute units of a CPU device to use; default: all");
  add_value(app, "--kernel-dir", kernel_dir, folder_text(),
            "read the kernels from here, not from the binary");
  app.add_flag_callback(
         "--no-cache", [&options] { options.keep_kernels = false; },
         "compile all kernels anew and keep none; else what was\n"
         "compiled is kept in $CAUSTICL_CACHE_DIR, by default\n"
         "~/.cache/causticl, for the next run")
      ->disable_flag_override();
}

}  // namespace causticl
