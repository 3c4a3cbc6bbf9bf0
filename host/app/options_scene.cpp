#include "app/option_binding.hpp"
#include "app/option_groups.hpp"

namespace causticl {

void add_scene_options(CLI::App& app, Options& options) {
  SceneOptions& scene = options.scene_options;
  app.add_option("SCENE", options.scene, "scene file (JSON)")->required()->type_name("");
  add_value(app, "--integrator", scene.integrator, integrator_choice(), "in place of the scene's own");
  add_value(app, "--size", scene.size, size_text(), "pixels of the image, as in 640x480");
  add_values(app, "-D", scene.overrides, override_text(),
             "set a key of the scene before it is read, as in\n"
             "-D renderer.radius=0.1; may be repeated");
}

}  // namespace causticl
