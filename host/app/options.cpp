#include "app/options.hpp"

#include <CLI/CLI.hpp>

#include "app/command_line_fault.hpp"
#include "app/option_checks.hpp"
#include "app/option_groups.hpp"
#include "base/error.hpp"

namespace causticl {
namespace {

const std::string exit_codes =
    "Exit codes: 0 done, 1 a fault of causticl, 2 of the input, 3 of the device,\n"
    "130 interrupted, with the image written.";

constexpr double most_error = 10;  // as a fraction

/// What CLI11 leaves as text.
struct Texts {
  std::string integrator, size, precision, triangle_test, wanted_error, confidence;
  std::vector<std::string> overrides;
};

/// The scene and what changes it as it is read: common to `render` and `info`.
void add_scene_options(CLI::App& app, Options& options, Texts& texts) {
  app.add_option("SCENE", options.scene, "scene file (JSON)")->required()->type_name("");
  app.add_option("--integrator", texts.integrator, "in place of the scene's own")
      ->transform(integrator_name())
      ->type_name(joined(integrator_names(), "|"));
  app.add_option("--size", texts.size, "pixels of the image, as in 640x480")
      ->check(
          expect("WxH in pixels, as in 640x480, each from 1 to " + std::to_string(largest_extent), is_size))
      ->type_name("WxH");
  app.add_option("-D", texts.overrides,
                 "set a key of the scene before it is read, as in\n"
                 "-D renderer.radius=0.1; may be repeated")
      ->check(expect("key=value, as in renderer.radius=0.1", is_override))
      ->type_name("key=value")
      ->allow_extra_args(false);
}

/// Where the picture goes and how long the render runs.
void add_output_options(CLI::App& app, Options& options, Texts& texts) {
  app.add_option("-o,--output", options.outputs,
                 "image to write: .png (tone-mapped), .exr or .pfm (linear);\n"
                 "may be repeated. Default: the scene's `path`, else its name\n"
                 "with .png in the working directory")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_flag("--layers", options.layers,
               "add to .exr files what of the light is direct, caustic and\n"
               "indirect, as layers that add up to the picture")
      ->disable_flag_override();
  const auto count = whole_number(1, largest_int);
  app.add_option("--passes", options.passes, "sppm: passes, in place of the scene's own")
      ->check(count)
      ->type_name("N");
  app.add_option("--photons", options.photons, "sppm: photons a pass, in place of the scene's own")
      ->check(count)
      ->type_name("N");
  app.add_option("--samples", options.samples, "pt: samples a pixel, in place of the scene's own")
      ->check(count)
      ->type_name("N");
  app.add_option(
         "--time", options.time_limit,
         "stop after this time if the passes are not done before:\nseconds, or as in 90s, 10m or 1h30m")
      ->transform(duration())
      ->type_name("TIME");
  app.add_option("--error", texts.wanted_error,
                 "stop when the picture's estimated error is this, as in 2%;\nthere is no limit of passes "
                 "then but --passes")
      ->check(fraction("a share between 0 and 1000%, as in 2% or 0.02", most_error))
      ->type_name("SHARE");
  app.add_option("--confidence", texts.confidence,
                 "the share of pixels that the error is to hold for; 90% by\ndefault")
      ->check(fraction("a share between 0 and 100%, as in 95% or 0.95", 1))
      ->type_name("SHARE");
  app.add_option("--seed", options.seed, "1 by default; the same seed gives the same image to the bit")
      ->check(whole_number(0, 4294967295))
      ->type_name("N");
}

/// How it computes.
void add_method_options(CLI::App& app, Options& options, Texts& texts) {
  app.add_option("--effects", options.effects,
                 "what the kernels are compiled for: auto, what the scene\n"
                 "calls for (the default); all; or a list of effects, as in\n"
                 "spheres,glass, which must hold what the scene calls for.\n"
                 "The picture is the same")
      ->type_name("auto|all|LIST");
  app.add_option("--precision", texts.precision,
                 "of the kernels' arithmetic; default: float. double needs a\n"
                 "device with fp64 and is slower: it is for measuring float")
      ->transform(one_of("float or double", {"float", "double"}))
      ->type_name("float|double");
  app.add_option("--triangle-test", texts.triangle_test,
                 "how rays meet triangles: watertight (the default) or by\n"
                 "precomputed transforms, which lets some pass at edges")
      ->transform(one_of("watertight or precomputed", {"watertight", "precomputed"}))
      ->type_name("TEST");
}

/// What it runs on.
void add_device_options(CLI::App& app, Options& options, bool takes_several = false) {
  const std::string several =
      "; several\nwith commas between them, or all, share every pass, to\nthe same picture";
  app.add_option("--device", options.device,
                 "index, cpu, gpu or part of a name (see `causticl devices`)" +
                     (takes_several ? several : std::string()) +
                     ";\ndefault: the first GPU, else the first device")
      ->type_name("SPEC");
  app.add_option("--threads", options.threads, "compute units of a CPU device to use; default: all")
      ->check(whole_number(1, largest_int))
      ->type_name("N");
  app.add_option("--kernel-dir", options.kernel_dir, "read the kernels from here, not from the binary")
      ->check(expect("an existing folder", is_folder))
      ->type_name("DIR");
  app.add_flag_callback(
         "--no-cache", [&options] { options.keep_kernels = false; },
         "compile all kernels anew and keep none; else what was\n"
         "compiled is kept in $CAUSTICL_CACHE_DIR, by default\n"
         "~/.cache/causticl, for the next run")
      ->disable_flag_override();
}

/// What it reports.
void add_report_options(CLI::App& app, Options& options) {
  app.add_option("--dump-kernels", options.dump_kernels, "write the kernels here as they were built")
      ->type_name("DIR");
  app.add_flag("--quiet", options.quiet, "print nothing but errors (and what --stats asks for)")
      ->disable_flag_override();
  app.add_flag("--stats", options.stats, "print a table of times, counts and memory at the end")
      ->disable_flag_override();
  app.add_option("--stats-json", options.stats_json, "write the same as one JSON object")->type_name("FILE");
}

/// What explaining a scene adds to reading it.
void add_explain_options(CLI::App& app, Options& options) {
  app.add_flag("--measure", options.measure,
               "render it small, with and without each effect, and say\n"
               "what each costs on this device")
      ->disable_flag_override();
  app.add_option("--json", options.json, "write the table as one JSON object")->type_name("FILE");
}

/// Two pictures and where their difference goes.
void add_compare_options(CLI::App& app, Options& options) {
  app.add_option("PICTURE", options.picture, "what was rendered: .exr, .pfm or .png")
      ->required()
      ->type_name("");
  app.add_option("REFERENCE", options.reference, "what it should be")->required()->type_name("");
  app.add_option("--map", options.error_map, "write FLIP as a picture: black is alike, bright far off")
      ->type_name("FILE");
  app.add_option("--json", options.json, "write the numbers as one JSON object")->type_name("FILE");
}

void add_commands(CLI::App& app, Options& options, Texts& texts) {
  CLI::App& render = *app.add_subcommand("render", "Render a scene to image files");
  add_scene_options(render, options, texts);
  add_output_options(render, options, texts);
  add_method_options(render, options, texts);
  add_device_options(render, options, true);
  add_report_options(render, options);
  render.footer(
      "Ctrl-C, SIGTERM and SIGHUP finish the pass and write the image; a second one stops at once.\n" +
      exit_codes);
  add_image_options(render, options);
  CLI::App& devices = *app.add_subcommand("devices", "List the OpenCL devices of this machine");
  devices.footer("The number in front of a device is its index for `causticl render --device`.");
  CLI::App& info = *app.add_subcommand("info", "Say what a scene holds; needs no device");
  add_scene_options(info, options, texts);
  add_image_options(info, options);
  CLI::App& explain =
      *app.add_subcommand("explain", "Say which effects a scene calls for, and what they cost");
  add_scene_options(explain, options, texts);
  add_explain_options(explain, options);
  add_image_options(explain, options);
  add_device_options(explain, options);
  explain.footer(
      "A cost is the time of all kernels over that without the effect: the median of five pairs of\n"
      "renders and half the distance of the quartiles. Without --measure no device is asked for.");
  CLI::App& compare = *app.add_subcommand("compare", "Say how far a picture is from a reference");
  add_compare_options(compare, options);
  add_image_options(compare, options);
  CLI::App& study =
      *app.add_subcommand("study", "Measure what accuracy costs in time, and recommend settings");
  add_scene_options(study, options, texts);
  add_study_options(study, options);
  add_image_options(study, options);
  add_device_options(study, options);
  study.footer(
      "A study that was interrupted or killed goes on where it was when it is started again; a larger\n"
      "--budget then adds to it. Without --size, pictures have at most about 25,600 pixels.\n" +
      exit_codes);
  CLI::App& selftest = *app.add_subcommand("selftest", "Check the numerics of the kernels on this device");
  add_selftest_options(selftest, options);
  add_device_options(selftest, options);
  selftest.footer(
      "The first thing to run when a picture looks wrong. Exit codes: 0 all checks passed, 2 the command\n"
      "line is at fault, 3 a check failed.");
  CLI::App& schema = *app.add_subcommand("schema", "Print the JSON Schema of scene files, for editors");
  schema.footer(
      "An editor that knows the schema completes keys and marks mistakes while you write. In a scene,\n"
      "\"$schema\": \"scene.schema.json\" names the file that holds it.");
}

constexpr std::pair<const char*, Options::Command> commands[]{
    {"render", Options::Command::render},   {"devices", Options::Command::devices},
    {"info", Options::Command::info},       {"schema", Options::Command::schema},
    {"explain", Options::Command::explain}, {"compare", Options::Command::compare},
    {"study", Options::Command::study},     {"selftest", Options::Command::selftest}};

/// From words to values.
void read_texts(const Texts& texts, Options& options) {
  options.selftest.threads = options.threads;
  options.selftest.kernel_dir = options.kernel_dir;
  if (!texts.integrator.empty()) options.scene_options.integrator = parse_integrator(texts.integrator);
  if (texts.precision == "double") options.precision = Precision::float64;
  if (texts.triangle_test == "precomputed") options.triangle_test = TriangleTest::precomputed;
  // Rays that leave a surface in double precision would meet it again where its transform was rounded.
  if (options.triangle_test == TriangleTest::precomputed && options.precision == Precision::float64)
    throw UserError(
        "--triangle-test precomputed: its transforms are stored in single precision; expected --precision "
        "float");
  if (!texts.wanted_error.empty()) options.wanted_error = parse_fraction(texts.wanted_error, most_error);
  if (!texts.confidence.empty()) options.confidence = *parse_fraction(texts.confidence, 1);
  if (!texts.size.empty()) options.scene_options.size = parse_size(texts.size);
  for (const auto& text : texts.overrides) {
    const auto equals = text.find('=');
    options.scene_options.overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
}

}  // namespace

Options parse_options(int argc, const char* const* argv) {
  Options options;
  Texts texts;
  CLI::App app("CaustiCL: a progressive photon mapper and path tracer for OpenCL devices", "causticl");
  app.require_subcommand(1);
  app.set_version_flag("--version", "causticl " CAUSTICL_VERSION);
  app.footer(exit_codes);
  app.get_formatter()->column_width(30);
  add_commands(app, options, texts);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    options.text = app.help();
    return options;
  } catch (const CLI::CallForVersion& version) {
    options.text = std::string(version.what()) + "\n";
    return options;
  } catch (const CLI::ParseError& error) {
    throw UserError(command_line_fault(error, app));
  }
  for (const auto& [name, command] : commands)
    if (app.got_subcommand(name)) options.command = command;
  read_texts(texts, options);
  return options;
}

}  // namespace causticl
