#include "app/option_binding.hpp"
#include "app/option_groups.hpp"

namespace causticl {

void add_selftest_options(CLI::App& app, Options& options) {
  SelftestOptions& selftest = options.selftest;
  const auto effort = [&](SelftestOptions::Effort value) {
    return [&selftest, value] { selftest.effort = value; };
  };
  auto* quick = app.add_flag_callback(
      "--quick", effort(SelftestOptions::Effort::quick),
      "10^5 inputs a check at most: under half a minute once the\nkernels are compiled; default: 10^6");
  app.add_flag_callback(
         "--full", effort(SelftestOptions::Effort::full),
         "10^8 inputs a hard case, shared by its checks, and at least\n10^6 a check: half an hour on "
         "two cores")
      ->excludes(quick);
  add_value(app, "--inputs", selftest.inputs, whole_number<std::uint64_t>(1, 1000000000000),
            "inputs a check");
  app.add_option("--case", selftest.checks,
                 "only these checks: the number of a hard case, or part\n"
                 "of a check's name; may be repeated")
      ->type_name("SPEC")
      ->allow_extra_args(false);
  add_text(app, "--replay", selftest.replay, "WORDS",
           "the one input of a check that failed, as it was printed");
  add_text(app, "--json", options.json, "FILE", "write the table as one JSON object");
  add_value(app, "--seed", selftest.seed, whole_number<std::uint32_t>(0, largest_seed),
            "of the random inputs; 1 by default");
}

}  // namespace causticl
