#include "app/options.hpp"

#include <CLI/CLI.hpp>

#include "app/command_line_fault.hpp"
#include "app/option_binding.hpp"
#include "app/option_groups.hpp"
#include "base/error.hpp"

namespace causticl {
namespace {

const std::string exit_codes =
    "Exit codes: 0 done, 1 a fault of causticl, 2 of the input, 3 of the device,\n"
    "130 interrupted, with the image written.";

/// What explaining a scene adds to reading it.
void add_explain_options(CLI::App& app, Options& options) {
  add_switch(app, "--measure", options.measure,
             "render it small, with and without each effect, and say\n"
             "what each costs on this device");
  add_text(app, "--json", options.json, "FILE", "write the table as one JSON object");
}

/// Two pictures and where their difference goes.
void add_compare_options(CLI::App& app, Options& options) {
  add_text(app, "PICTURE", options.picture, "", "what was rendered: .exr, .pfm or .png")->required();
  add_text(app, "REFERENCE", options.reference, "", "what it should be")->required();
  add_text(app, "--map", options.error_map, "FILE",
           "write FLIP as a picture: black is alike, bright far off");
  add_text(app, "--json", options.json, "FILE", "write the numbers as one JSON object");
}

void add_commands(CLI::App& app, Options& options) {
  RenderOptions& on = options.render;
  CLI::App& render = *app.add_subcommand("render", "Render a scene to image files");
  add_scene_options(render, options);
  add_render_options(render, options);
  render.footer(
      "Ctrl-C, SIGTERM and SIGHUP finish the pass and write the image; a second one stops at once.\n" +
      exit_codes);
  add_image_options(render, options);
  CLI::App& merge = *app.add_subcommand("merge", "Put parts of a render together: passes and crops");
  add_merge_options(merge, options);
  merge.footer(
      "Films of the same pixels are added up, which their renders must allow; crops are put side by side.\n"
      "The result has the bits of one render of all passes and pixels.");
  CLI::App& devices = *app.add_subcommand("devices", "List the OpenCL devices of this machine");
  devices.footer("The number in front of a device is its index for `causticl render --device`.");
  CLI::App& info = *app.add_subcommand("info", "Say what a scene holds; needs no device");
  add_scene_options(info, options);
  add_image_options(info, options);
  CLI::App& explain =
      *app.add_subcommand("explain", "Say which effects a scene calls for, and what they cost");
  add_scene_options(explain, options);
  add_explain_options(explain, options);
  add_image_options(explain, options);
  add_device_options(explain, options, on.threads, on.kernel_dir);
  explain.footer(
      "A cost is the time of all kernels over that without the effect: the median of five pairs of\n"
      "renders and half the distance of the quartiles. Without --measure no device is asked for.");
  CLI::App& compare = *app.add_subcommand("compare", "Say how far a picture is from a reference");
  add_compare_options(compare, options);
  add_image_options(compare, options);
  CLI::App& study =
      *app.add_subcommand("study", "Measure what accuracy costs in time, and recommend settings");
  add_scene_options(study, options);
  add_study_options(study, options);
  add_image_options(study, options);
  add_device_options(study, options, on.threads, on.kernel_dir);
  study.footer(
      "A study that was interrupted or killed goes on where it was when it is started again; a larger\n"
      "--budget then adds to it. Without --size, pictures have at most about 25,600 pixels.\n" +
      exit_codes);
  CLI::App& selftest = *app.add_subcommand("selftest", "Check the numerics of the kernels on this device");
  add_selftest_options(selftest, options);
  add_device_options(selftest, options, options.selftest.threads, options.selftest.kernel_dir);
  selftest.footer(
      "The first thing to run when a picture looks wrong. Exit codes: 0 all checks passed, 2 the command\n"
      "line is at fault, 3 a check failed.");
  CLI::App& schema = *app.add_subcommand("schema", "Print the JSON Schema of scene files, for editors");
  schema.footer(
      "An editor that knows the schema completes keys and marks mistakes while you write. In a scene,\n"
      "\"$schema\": \"scene.schema.json\" names the file that holds it.");
}

constexpr std::pair<const char*, Options::Command> commands[]{
    {"render", Options::Command::render},    {"merge", Options::Command::merge},
    {"devices", Options::Command::devices},  {"info", Options::Command::info},
    {"schema", Options::Command::schema},    {"explain", Options::Command::explain},
    {"compare", Options::Command::compare},  {"study", Options::Command::study},
    {"selftest", Options::Command::selftest}};

/// Throws UserError for options that do not go together.
void check_together(const Options& options) {
  // Rays that leave a surface in double precision would meet it again where its transform was rounded.
  if (options.render.triangle_test == TriangleTest::precomputed &&
      options.render.precision == Precision::float64)
    throw UserError(
        "--triangle-test precomputed: its transforms are stored in single precision; expected --precision "
        "float");
  if (!options.checkpoint.empty() && !options.film.empty())
    throw UserError("--film and --checkpoint: both write the film in the end; expected one of them");
  if (options.command == Options::Command::merge && options.render.outputs.empty() && options.film.empty())
    throw UserError("merge: where does the whole go? expected -o FILE for a picture, or --film FILE");
  if (options.checkpoint_interval && options.checkpoint.empty() && options.render.film.resume.empty())
    throw UserError(
        "--every: says how often --checkpoint writes its film; expected --checkpoint FILE with it");
  if (options.render.film.range && options.render.wanted_error)
    throw UserError(
        "--pass-range and --error: a part has a number of passes of its own; leave one of them out");
}

}  // namespace

std::unique_ptr<CLI::App> command_line(Options& options) {
  auto app = std::make_unique<CLI::App>(
      "CaustiCL: a progressive photon mapper and path tracer for OpenCL devices", "causticl");
  app->require_subcommand(1);
  app->set_version_flag("--version", "causticl " CAUSTICL_VERSION);
  app->footer(exit_codes);
  app->get_formatter()->column_width(30);
  add_commands(*app, options);
  return app;
}

Options parse_options(int argc, const char* const* argv) {
  Options options;
  const auto app = command_line(options);
  try {
    app->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    options.text = app->help();
    return options;
  } catch (const CLI::CallForVersion& version) {
    options.text = std::string(version.what()) + "\n";
    return options;
  } catch (const CLI::ParseError& error) {
    throw UserError(command_line_fault(error, *app));
  }
  for (const auto& [name, command] : commands)
    if (app->got_subcommand(name)) options.command = command;
  check_together(options);
  return options;
}

}  // namespace causticl
