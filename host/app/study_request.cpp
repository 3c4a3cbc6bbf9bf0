#include "app/study_request.hpp"

#include "app/render_setup.hpp"

namespace causticl {
namespace {

/// What `causticl render` renders with these words, besides what every render of a study has from the study's
/// own command line.
RenderSetup render_setup(const Options& study, const std::vector<std::string>& words) {
  std::vector<const char*> arguments{"causticl", "render", study.scene.c_str()};
  for (const auto& word : words) arguments.push_back(word.c_str());
  Options options = parse_options(static_cast<int>(arguments.size()), arguments.data());
  options.threads = study.threads;
  options.kernel_dir = study.kernel_dir;
  options.scene_options.image_limits = study.scene_options.image_limits;
  Scene scene = load_scene(options.scene, options.scene_options);
  apply_options(options, scene);
  return {std::move(scene), options.scene_options, render_options(options, {}), options.device};
}

}  // namespace

StudyRequest study_request(const Options& options) {
  return {options.scene,
          options.scene_options,
          options.study,
          options.seed,
          options.device,
          options.threads,
          options.kernel_dir,
          [options](const std::vector<std::string>& words) { return render_setup(options, words); }};
}

}  // namespace causticl
