#include "app/option_checks.hpp"
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
  app.add_option("--inputs", selftest.inputs, "inputs a check")
      ->check(whole_number(1, 1000000000000))
      ->type_name("N");
  app.add_option("--case", selftest.checks,
                 "only these checks: the number of a hard case, or part\n"
                 "of a check's name; may be repeated")
      ->type_name("SPEC")
      ->allow_extra_args(false);
  app.add_option("--replay", selftest.replay, "the one input of a check that failed, as it was printed")
      ->type_name("WORDS");
  app.add_option("--json", options.json, "write the table as one JSON object")->type_name("FILE");
  app.add_option("--seed", selftest.seed, "of the random inputs; 1 by default")
      ->check(whole_number(0, 4294967295))
      ->type_name("N");
}

}  // namespace causticl
