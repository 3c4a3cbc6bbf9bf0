// The table of the whole file, and of the key `medium`.
#include "format/scene_keys.hpp"
#include "scene/scene.hpp"

namespace causticl {
namespace {

using namespace types;

const SceneTable& medium_keys() {
  static const SceneTable table{
      "medium",
      "",
      "homogeneous medium that fills all space outside glass",
      {{"absorption", color(non_negative_number), 0, "absorption coefficient", "per unit length"},
       {"scattering", color(non_negative_number), 0, "scattering coefficient", "per unit length"},
       {"g", number({-0.99, 0.99, "a mean cosine from -0.99 to 0.99"}), MediumSpec{}.g,
        "mean cosine of the Henyey-Greenstein phase function; positive scatters forward"}}};
  return table;
}

std::vector<SceneKey> rows_of_scene() {
  using Described = Absent::Described;
  const Scene absent;
  const ValueType ignored = integer(0, std::int64_t{1} << 53);
  return {
      {"path", string(), Described{"the scene's name with .png"},
       "picture to write; the extension picks the format"},
      {"width", integer(1, most_pixels), absent.width, "width of the picture", "pixels"},
      {"height", integer(1, most_pixels), absent.height, "height of the picture", "pixels"},
      {"sample", integer(1, 1 << 30), optional,
       "base format without \"renderer\": path tracing with this many samples a pixel"},
      {"max_depth", integer(1, 100000), absent.max_depth, "longest path", "surface hits"},
      {"Na", number(refractive_index), absent.outside_ior,
       "index of refraction of what lies around all glass"},
      {"Ng", number(refractive_index), 1.5, "index of refraction of glass that states none"},
      {"thread_num", ignored, optional, "base format; ignored with a note"},
      {"stack_size", ignored, optional, "base format; ignored with a note"},
      {"camera", camera_type(), required, "where the picture is seen from"},
      {"renderer", renderer_type(), Described{"SPPM with its defaults"}, "integrator and its settings"},
      {"materials", map(material_type()), optional, "materials by name, for objects to use"},
      {"objects", list(1, SIZE_MAX, "object", object_type()), required, "surfaces"},
      {"lights", list(0, SIZE_MAX, "lights", light_type()), optional, "lights beside the surfaces that emit"},
      {"medium", medium_type(), optional, "what fills the scene"},
      {"$schema", string(), optional, "for editors: where the JSON Schema of this format is"}};
}

}  // namespace

ValueType medium_type() { return object("medium", {&medium_keys}); }

const SceneTable& scene_keys() {
  static const SceneTable table{"scene",
                                "",
                                "scene",
                                rows_of_scene(),
                                {{KeyRule::Relation::not_both, "renderer", "sample", "sample",
                                  "expected \"sample\" inside \"renderer\", got it beside"}}};
  return table;
}

}  // namespace causticl
