#include "app/option_binding.hpp"
#include "app/option_groups.hpp"
#include "study/study_parameters.hpp"

namespace causticl {

void add_study_options(CLI::App& app, Options& options) {
  StudyOptions& study = options.study;
  add_text(app, "-o,--output", study.folder, "FOLDER",
           "folder for study.html, study.csv and study.json; default: the\n"
           "scene's name with -study in the working directory");
  add_value(app, "--budget", study.budget, duration_text(),
            "time that all of it may take, in seconds or as in 10m; 300 by\ndefault");
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
  add_value(app, "--seeds", study.seeds, whole_number<int>(2, 16),
            "renders of each setting, as far as there is time; default: 3");
  add_text(app, "--reference", study.reference, "FILE",
           "picture to measure errors against, of the same size; default:\n"
           "the study renders its own, within the budget");
  add_switch(app, "--restart", study.restart, "throw away the study that the folder holds");
  add_value(app, "--seed", options.render.seed, whole_number<std::uint32_t>(0, 4000000000),
            "of the first render of each setting; 1 by default");
  add_switch(app, "--quiet", options.quiet, "print nothing but errors and the summary");
}

}  // namespace causticl
