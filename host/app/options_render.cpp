#include "app/option_binding.hpp"
#include "app/option_groups.hpp"

namespace causticl {
namespace {

constexpr double most_error = 10;  // as a fraction

/// An option that replaces `field`, which those integrators have that `has` says yes to.
template <typename Value, typename Has>
void add_renderer_option(CLI::App& app, Options& options, const std::string& name, Value RendererSpec::*field,
                         const Has& has, const std::string& help) {
  const auto integrators = integrators_with(has);
  const auto text = whole_number<Value>(1, largest_int);
  const auto add = [&options, name, integrators, field, read = text.read](const std::string& word) {
    const Value value = *read(word);
    options.renderer_options.push_back(
        {name, integrators, [field, value](RendererSpec& renderer) { renderer.*field = value; }});
  };
  bind_text<std::string>(app, name, add, text,
                         joined(integrators, ", ") + ": " + help + ", in place of the scene's own");
}

/// Where the picture goes and how long the render runs.
void add_output_options(CLI::App& app, Options& options) {
  RenderOptions& render = options.render;
  app.add_option("-o,--output", render.outputs,
                 "image to write: .png (tone-mapped), .exr or .pfm (linear);\n"
                 "may be repeated. Default: the scene's `path`, else its name\n"
                 "with .png in the working directory")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_switch(app, "--layers", render.layers,
             "add to .exr files what of the light is direct, caustic and\n"
             "indirect, as layers that add up to the picture");
  const auto counted_by = [](int RendererSpec::*field) {
    return [=](const IntegratorRow& row) { return row.passes == field; };
  };
  add_renderer_option(app, options, "--passes", &RendererSpec::passes, counted_by(&RendererSpec::passes),
                      "passes");
  add_renderer_option(
      app, options, "--photons", &RendererSpec::photons,
      [](const IntegratorRow& row) { return traces_photons(row.integrator); }, "photons a pass");
  add_renderer_option(app, options, "--samples", &RendererSpec::samples, counted_by(&RendererSpec::samples),
                      "samples a pixel");
  add_value(app, "--time", render.time_limit, duration_text(),
            "stop after this time if the passes are not done before:\nseconds, or as in 90s, 10m or 1h30m");
  add_value(app, "--error", render.wanted_error,
            fraction_text("a share between 0 and 1000%, as in 2% or 0.02", most_error),
            "stop when the picture's estimated error is this, as in 2%;\nthere is no limit of passes "
            "then but --passes");
  add_value(app, "--confidence", render.confidence,
            fraction_text("a share between 0 and 100%, as in 95% or 0.95", 1),
            "the share of pixels that the error is to hold for; 90% by\ndefault");
  add_value(app, "--seed", render.seed, whole_number<std::uint32_t>(0, largest_seed),
            "1 by default; the same seed gives the same image to the bit");
}

/// The film file, from which a render goes on and by which parts are put together.
void add_film_options(CLI::App& app, Options& options) {
  FilmOptions& film = options.render.film;
  add_text(
      app, "--checkpoint", options.checkpoint, "FILE",
      "keep all that was rendered so far in this film while passes go\non, so that --resume goes on from it");
  add_value(app, "--every", options.checkpoint_interval, duration_text(),
            "how often --checkpoint writes its film; 60 s by default");
  add_text(
      app, "--resume", film.resume, "FILE",
      "go on from a film: more passes, other limits. Also keeps the\nnew passes there, as --checkpoint does");
  add_value(app, "--pass-range", film.range, pass_range_text(),
            "render these passes alone, as 65:128; for `causticl merge`");
  add_value(app, "--crop", options.crop, crop_text(),
            "render these pixels alone: left, top, right and bottom edge in\npixels, or with a decimal point "
            "as fractions "
            "of the picture");
  add_text(app, "--film", options.film, "FILE", "write the film in the end: a part for `causticl merge`");
}

/// How it computes.
void add_method_options(CLI::App& app, RenderOptions& render) {
  add_text(app, "--effects", render.effects, "auto|all|LIST",
           "what the kernels are compiled for: auto, what the scene\n"
           "calls for (the default); all; or a list of effects, as in\n"
           "spheres,glass, which must hold what the scene calls for.\n"
           "The picture is the same");
  add_value(
      app, "--precision", render.precision,
      choice_text<Precision>("float|double", {{"float", Precision::float32}, {"double", Precision::float64}}),
      "of the kernels' arithmetic; default: float. double needs a\n"
      "device with fp64 and is slower: it is for measuring float");
  add_value(app, "--triangle-test", render.triangle_test,
            choice_text<TriangleTest>("TEST", {{"watertight", TriangleTest::watertight},
                                               {"precomputed", TriangleTest::precomputed}}),
            "how rays meet triangles: watertight (the default) or by\n"
            "precomputed transforms, which lets some pass at edges");
}

/// What it reports.
void add_report_options(CLI::App& app, Options& options) {
  add_text(app, "--dump-kernels", options.render.dump_kernels, "DIR",
           "write the kernels here as they were built");
  add_switch(app, "--quiet", options.quiet, "print nothing but errors (and what --stats asks for)");
  add_switch(app, "--stats", options.stats, "print a table of times, counts and memory at the end");
  add_text(app, "--stats-json", options.stats_json, "FILE", "write the same as one JSON object");
}

}  // namespace

void add_render_options(CLI::App& app, Options& options) {
  add_output_options(app, options);
  add_film_options(app, options);
  add_method_options(app, options.render);
  add_device_options(app, options, options.render.threads, options.render.kernel_dir, true);
  add_report_options(app, options);
}

}  // namespace causticl
