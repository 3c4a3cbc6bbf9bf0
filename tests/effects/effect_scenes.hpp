// For each effect a small scene that calls for it, and the same scene without what calls.
#pragma once

#include <string>
#include <vector>

namespace causticl {

struct EffectScene {
  std::string key;      // of the effect
  std::string with;     // a scene file
  std::string without;  // calls for all the same but this effect
  std::string reason;   // what calls for it in `with`
};

/// A lamp over a floor, and more keys and objects: every scene here has triangles, a sphere and shadow rays,
/// but for what is left out.
inline std::string effect_scene(const std::string& object, const std::string& camera = "",
                                const std::string& renderer = "") {
  const std::string floor =
      R"({"type": "rectangle", "material": {"type": "diffuse", "color": [0.7, 0.6, 0.5]},
     "transform": [{"type": "scale", "x": 6, "y": 6, "z": 1}, {"type": "rotate", "axis": "x", "degree": -90}]})";
  const std::string lamp =
      R"({"type": "sphere", "radius": 0.4, "material": {"type": "diffuse", "emission": [20, 20, 20]},
     "transform": [{"type": "shift", "x": 0, "y": 4, "z": 1}]})";
  return R"({"width": 16, "height": 12, "max_depth": 6,
    "camera": {"position": [0, 2, 7], "target": [0, 1, 0], "fov": 40)" +
         camera + R"(}, "renderer": {"type": "sppm", "radius": 0.2, "photon_sample": 2000)" + renderer +
         R"(}, "objects": [)" + floor + "," + lamp + (object.empty() ? "" : "," + object) + "]}";
}

inline std::string ball_of(const std::string& material) {
  return R"({"type": "sphere", "radius": 0.8, "material": )" + material +
         R"(, "transform": [{"type": "shift", "x": 0, "y": 0.8, "z": 0}]})";
}

inline std::vector<EffectScene> effect_scenes() {
  const std::string diffuse = R"({"type": "diffuse"})", plain = effect_scene(ball_of(diffuse));
  const auto with_ball = [&](const std::string& key, const std::string& material, const std::string& plainer,
                             const std::string& reason) {
    return EffectScene{key, effect_scene(ball_of(material)), effect_scene(ball_of(plainer)), reason};
  };
  const auto with_light = [](const std::string& light) {
    return "{\"lights\": [" + light + "], " + effect_scene("").substr(1);
  };
  const auto picture_lamp = [](const std::string& radiance) {
    return R"({"type": "rectangle", "position": [0, 3, -1], "normal": [0, -1, 1], "size": [2, 1], "radiance": )" +
           radiance + "}";
  };
  const auto with_mesh = [](bool smooth) {
    return effect_scene(R"({"type": "mesh", "path": ")" CAUSTICL_SOURCE_DIR
                        R"(/scenes/assets/pawn.obj", "smooth": )" +
                        std::string(smooth ? "true" : "false") + R"(, "material": {"type": "diffuse"}})");
  };
  const auto with_box = [](const std::string& height) {
    return effect_scene(R"({"type": "box", "size": [2, )" + height +
                        R"(, 2], "material": {"type": "diffuse"}})");
  };
  const std::string plane = R"({"type": "plane", "material": {"type": "diffuse"}})";
  const std::string sun = R"({"type": "directional", "direction": [0, -1, 0], "irradiance": [1, 1, 1]})";
  const std::string bulb = R"({"type": "point", "position": [1, 2, 3], "intensity": [1, 1, 1]})";
  const std::string lamp = R"({"type": "diffuse", "emission": [20, 20, 20]})";
  const std::string balls =
      R"({"camera": {"position": [0, 2, 7], "target": [0, 1, 0], "fov": 40}, "objects": [)";
  return {
      {"triangles", effect_scene(""), balls + ball_of(lamp) + "]}", "rectangle /objects/0"},
      {"spheres", plain,
       R"({"camera": {"position": [0, 2, 7], "target": [0, 1, 0], "fov": 40}, "objects": [
          {"type": "rectangle", "material": {"type": "diffuse", "emission": [1, 1, 1]}}]})",
       "sphere /objects/1 and 1 more"},
      {"planes", effect_scene(R"({"type": "plane", "material": {"type": "diffuse"}})"), effect_scene(""),
       "plane /objects/2"},
      {"disks", effect_scene(R"({"type": "disk", "radius": 1, "material": {"type": "diffuse"}})"),
       effect_scene(""), "disk /objects/2"},
      {"curves", effect_scene(R"({"type": "bezier_rotate", "point": [[0, 0], [1, 0.2], [0.5, 1]],
                       "material": {"type": "diffuse"}})"),
       effect_scene(""), "bezier_rotate /objects/2"},
      {"cylinders", effect_scene(R"({"type": "cylinder", "height": 1, "material": {"type": "diffuse"}})"),
       effect_scene(""), "cylinder /objects/2"},
      with_ball(
          "textures",
          R"({"type": "diffuse", "color": {"type": "checker", "a": [1, 1, 1], "b": [0, 0, 0], "scale": [4, 4]}})",
          diffuse, "texture of /objects/2/material"),
      with_ball("mirror", R"({"type": "mirror"})", diffuse, "mirror of /objects/2/material"),
      with_ball("glass", R"({"type": "glass"})", diffuse, "glass of /objects/2/material"),
      {"lens", effect_scene(ball_of(diffuse), R"(, "aperture": 0.1, "focus_distance": 6)"), plain,
       "/camera/aperture"},
      {"shadow_rays", plain, effect_scene(ball_of(diffuse), "", R"(, "direct_light": "photons")"),
       "/renderer/direct_light with the emitter /objects/1"},
      with_ball("rough", R"({"type": "glass", "roughness": 0.3})", R"({"type": "glass"})",
                "roughness of /objects/2/material"),
      with_ball("conductor", R"({"type": "conductor", "eta": [0.2, 0.9, 1.1], "k": [3.9, 2.4, 2.2]})",
                diffuse, "conductor of /objects/2/material"),
      with_ball("plastic", R"({"type": "plastic"})", diffuse, "plastic of /objects/2/material"),
      with_ball("oren_nayar", R"({"type": "oren_nayar"})", diffuse, "oren_nayar of /objects/2/material"),
      with_ball("thin_glass", R"({"type": "thin_glass"})", diffuse, "thin_glass of /objects/2/material"),
      {"environment", with_light(R"({"type": "environment", "radiance": [1, 1, 1]})"), effect_scene(""),
       "environment /lights/0"},
      {"delta_lights", with_light(R"({"type": "point", "position": [1, 2, 3], "intensity": [1, 1, 1]})"),
       with_light(R"({"type": "point", "position": [1, 2, 3], "intensity": [0, 0, 0]})"),
       "point light /lights/0"},
      {"image_lights",
       with_light(picture_lamp(R"({"type": "image", "path": ")" CAUSTICL_SOURCE_DIR
                               R"(/scenes/assets/straw.png"})")),
       with_light(picture_lamp("1")), "rectangle light /lights/0"},
      with_ball("absorption", R"({"type": "glass", "absorption": [0, 1, 2]})",
                R"({"type": "glass", "absorption": [0, 0, 0]})", "absorption of /objects/2/material"),
      with_ball("dispersion", R"({"type": "glass", "cauchy": [1.5, 0.01]})",
                R"({"type": "glass", "cauchy": [1.5, 0]})", "cauchy of /objects/2/material"),
      {"motion",
       effect_scene(
           R"({"type": "sphere", "radius": 1, "material": {"type": "diffuse"}, "motion": {"shift": [1, 0, 0]}})"),
       effect_scene(
           R"({"type": "sphere", "radius": 1, "material": {"type": "diffuse"}, "motion": {"shift": [1, 0, 0]}})",
           R"(, "shutter": [0.5, 0.5])"),
       "motion of /objects/2"},
      {"medium", R"({"medium": {"scattering": [0.1, 0.1, 0.1]}, )" + plain.substr(1),
       R"({"medium": {"scattering": [0, 0, 0]}, )" + plain.substr(1), "/medium"},
      {"guided_photons", effect_scene("", "", R"(, "guided_photons": true)"), effect_scene(""),
       "/renderer/guided_photons"},
      {"aimed_photons", effect_scene(ball_of(R"({"type": "mirror"})"), "", R"(, "aimed_photons": true)"),
       effect_scene(ball_of(R"({"type": "mirror"})")), "type of /objects/2/material"},
      {"smooth", with_mesh(true), with_mesh(false), "normals of mesh /objects/2"},
      {"needles", with_box("0.1"), with_box("1"), "triangles of box /objects/2"},
      {"nested", effect_scene(ball_of(R"({"type": "glass"})")),
       effect_scene(R"({"type": "sphere", "radius": 0.8, "material": {"type": "glass"},
                       "transform": [{"type": "shift", "x": 0, "y": 1.5, "z": 0}]})"),
       "/objects/2 touches /objects/0"},
      {"walls", plain,
       effect_scene(ball_of(diffuse).replace(ball_of(diffuse).find("\"y\": 0.8"), 8, "\"y\": 40")),
       "surfaces about /objects/2"},
      {"horizon", "{\"lights\": [" + sun + "], " + effect_scene(plane).substr(1),
       "{\"lights\": [" + bulb + "], " + effect_scene(plane).substr(1), "plane /objects/2"},
  };
}

}  // namespace causticl
