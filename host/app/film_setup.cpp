#include "app/film_setup.hpp"

#include <cmath>
#include <filesystem>

#include "base/distinct_files.hpp"
#include "base/error.hpp"
#include "base/output_file.hpp"
#include "base/spelling.hpp"
#include "integrators/integrators.hpp"
#include "scene/integrators.hpp"
#include "study/study_inputs.hpp"

namespace causticl {
namespace {

constexpr double usual_interval = 60;  // seconds

/// The hash of all bytes that the scene was read from. Names of files are no part of it: a part may be
/// rendered on a machine that has them elsewhere.
std::string scene_hash(const Scene& scene) {
  std::string hash = file_hash(scene.file);
  for (const auto& file : scene.assets) hash = content_hash(file_hash(file), hash);
  return hash;
}

/// The renderer's settings without how many passes there are.
std::string renderer_text(RendererSpec renderer) {
  renderer.passes = renderer.samples = 1;
  return integrator_text(renderer);
}

PixelRect pixels_of(const CropText& crop, const Scene& scene) {
  const auto edge = [&](std::size_t i, int size) {
    return static_cast<int>(crop.is_fraction ? std::lround(crop.edge[i] * size) : std::lround(crop.edge[i]));
  };
  const PixelRect rect{edge(0, scene.width), edge(1, scene.height), edge(2, scene.width),
                       edge(3, scene.height)};
  const std::string size = std::to_string(scene.width) + "x" + std::to_string(scene.height);
  if (rect.x1 > scene.width || rect.y1 > scene.height)
    throw UserError("--crop " + text_of(rect) + ": reaches beyond the picture; expected edges within its " +
                    size);
  if (rect.x0 == rect.x1 || rect.y0 == rect.y1)
    throw UserError("--crop " + text_of(rect) + ": holds no pixel of the picture's " + size +
                    "; expected a larger part");
  return rect;
}

}  // namespace

RenderIdentity identity_of(const Options& options, const Scene& scene) {
  std::vector<std::string> overrides;
  for (const auto& change : options.scene_options.overrides)
    overrides.push_back(change.key + "=" + change.value);
  return {{"scene", scene_hash(scene)},
          {"-D", overrides.empty() ? "none" : joined(overrides, " ")},
          {"size", std::to_string(scene.width) + "x" + std::to_string(scene.height)},
          {"integrator", name_of(scene.renderer.integrator)},
          {"renderer", renderer_text(scene.renderer)},
          {"seed", std::to_string(options.render.seed)},
          {"precision", name_of(options.render.precision)},
          {"triangle test",
           options.render.triangle_test == TriangleTest::watertight ? "watertight" : "precomputed"},
          {"layers", options.render.layers ? "yes" : "no"},
          {"kernels", kernels_hash(options.render.kernel_dir)}};
}

void check_film_place(const std::string& file, bool is_read) {
  check_writable(file);
  std::error_code unreadable;
  if (!is_read && std::filesystem::is_regular_file(file, unreadable) &&
      std::filesystem::file_size(file, unreadable) > 0 && !is_film(file))
    throw UserError(file +
                    ": is there already and is no film; expected a new name for the film, or that of a film");
}

void set_film(const Options& options, const Scene& scene, RenderOptions& render) {
  FilmOptions& film = render.film;
  const bool goes_on = !film.resume.empty();
  if (options.crop) film.crop = pixels_of(*options.crop, scene);
  film.file = !options.checkpoint.empty() ? options.checkpoint
              : !options.film.empty()     ? options.film
                                          : film.resume;
  if (!options.checkpoint.empty() || (goes_on && options.film.empty()))
    film.every = options.checkpoint_interval.value_or(usual_interval);
  if (film.range && film.file.empty())
    throw UserError("--pass-range: a part is kept as a film; expected --film FILE with it");
  std::vector<NamedFile> files{{"the film", film.file}, {"the statistics", options.stats_json}};
  if (film.resume != film.file) files.push_back({"the film to go on from", film.resume});
  for (const auto& file : render.outputs) files.push_back({"a picture", file});
  check_distinct(files);
  if (film.file.empty() && !goes_on) return;
  film.identity = identity_of(options, scene);
  if (film.file.empty()) return;
  check_film_place(film.file, film.file == film.resume);
  if (!options.checkpoint.empty() && film.file != film.resume && is_film(film.file))
    throw UserError(film.file + ": holds a film already; go on from it with --resume " + film.file +
                    ", or remove it to begin anew");
}

}  // namespace causticl
