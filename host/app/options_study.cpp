#include "app/option_checks.hpp"
#include "app/option_groups.hpp"
#include "study/study_parameters.hpp"

namespace causticl {

void add_study_options(CLI::App& app, Options& options) {
  StudyOptions& study = options.study;
  app.add_option("-o,--output", study.folder,
                 "folder for study.html, study.csv and study.json; default: the\n"
                 "scene's name with -study in the working directory")
      ->type_name("FOLDER");
  app.add_option("--budget", study.budget,
                 "time that all of it may take, in seconds or as in 10m; 300 by\ndefault")
      ->transform(duration())
      ->type_name("TIME");
  std::string names;
  for (const StudyParameter& parameter : study_parameters())
    names += (names.empty() ? "" : ", ") + std::string(parameter.name);
  app.add_option("--parameters", study.parameters,
                 "only these, with commas between them:\n" + wrapped(names, 52))
      ->delimiter(',')
      ->type_name("LIST")
      ->allow_extra_args(false);
  // As it was called up to version 0.1.
  app.add_option("--knobs", study.parameters)->delimiter(',')->allow_extra_args(false)->group("");
  app.add_option("--seeds", study.seeds, "renders of each setting, as far as there is time; default: 3")
      ->check(whole_number(2, 16))
      ->type_name("N");
  app.add_option("--reference", study.reference,
                 "picture to measure errors against, of the same size; default:\n"
                 "the study renders its own, within the budget")
      ->type_name("FILE");
  app.add_flag("--restart", study.restart, "throw away the study that the folder holds")
      ->disable_flag_override();
  app.add_option("--seed", options.seed, "of the first render of each setting; 1 by default")
      ->check(whole_number(0, 4000000000))
      ->type_name("N");
  app.add_flag("--quiet", options.quiet, "print nothing but errors and the summary")->disable_flag_override();
}

}  // namespace causticl
