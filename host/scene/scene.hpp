// What a scene file says, as plain data: the input of everything that follows.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/vec.hpp"
#include "image/image.hpp"
#include "mesh/mesh.hpp"
#include "scene/integrator_table.hpp"
#include "shared/lights.h"
#include "shared/materials.h"
#include "shared/shapes.h"

namespace causticl {

using Color = Vec3;  // linear RGB

struct TextureSpec {
  enum class Kind { image, checker };
  /// JSON pointer, "/materials/wood/color"; empty for the base format's, without a filter.
  std::string pointer;
  Kind kind = Kind::image;
  int image = -1;  // index into Scene::images
  bool bilinear = false;
  std::array<double, 2> scale{1, 1};  // multiplies (u, v) before the lookup
  Color a, b;                         // checker: the colours of even and odd cells
};

struct MaterialSpec {
  std::string pointer;  // JSON pointer, "/materials/gold", "/objects/3/texture"
#define KIND_OF_ROW(x, NAME, number, name, effect, family, layers, fields, properties, ...) name = number,
  enum class Kind : unsigned { MATERIAL_TABLE(KIND_OF_ROW, ) };
#undef KIND_OF_ROW
  Kind kind = Kind::diffuse;
  Color color{1, 1, 1};
  int color_texture = -1;      // index into Scene::textures; replaces `color`
  bool alpha_diffuse = false;  // base format: texels with alpha > 0 are diffuse whatever `kind` says
  Color emission;              // radiance
  bool two_sided = false;      // emits on both sides
  int light = -1;              // index into Scene::lights: the one that lies on it, whose mean `emission` is
  double ior = 1.5;      // glass, plastic, thin_glass: the index inside; Scene::outside_ior is around it
  Color eta, k;          // conductor: real and imaginary part of the index
  double roughness = 0;  // glass, conductor, plastic: the square root of GGX's alpha
  double diffuse_roughness = 0.5;  // oren_nayar: r of EON
  Vec3 absorption;                 // glass: per unit length inside
  int priority = 0;                // glass: the higher one fills where dielectrics overlap
  double dispersion = 0;           // glass: B of Cauchy's index ior + B / wavelength^2, in square micrometres
};

struct Object {
#define SHAPE_OF_ROW(x, NAME, number, name, type, effect, points) name,
#define TRIANGLES_OF_ROW(x, name, type) name,
  enum class Shape { SHAPE_TABLE(SHAPE_OF_ROW, ) TRIANGLE_SHAPE_TABLE(TRIANGLES_OF_ROW, ) };
#undef SHAPE_OF_ROW
#undef TRIANGLES_OF_ROW
  Shape shape = Shape::sphere;
  std::string pointer;  // JSON pointer, "/objects/3"; "/renderer" for the disc light
  Transform transform;  // local to world
  int material = 0;     // index into Scene::materials
  double radius = 1;    // sphere, disk: in local units
  Vec3 size{1, 1, 1};   // box: edge lengths, centred on the local origin
  int mesh = -1;        // index into Scene::meshes
  bool smooth = true;   // mesh: use the file's vertex normals, or averaged ones where it has none
  std::vector<std::array<double, 2>> points;  // bezier: control points (radius, height)
  std::array<double, 2> own{};                // what the file of any other shape keeps of its keys
  Vec3 motion;                                // what it moves by in a unit of time, from time 0
  bool is_disc_light = false;                 // comes from renderer.light_pos
};

/// A light of the key `lights`. Its fields are those of its keys in LIGHT_TABLE.
struct LightSpec {
#define KIND_OF_LIGHT(x, NAME, number, name, ...) name,
  enum class Kind : unsigned { LIGHT_TABLE(KIND_OF_LIGHT, ) };
#undef KIND_OF_LIGHT
  Kind kind = Kind::point;
  std::string pointer;  // JSON pointer, "/lights/0"
  Vec3 position;
  Vec3 direction;   // unit: spot: the axis of its cone; directional: of travel; surfaces: the side that emits
  Color intensity;  // directional: irradiance of a surface across it; surfaces: radiance
  double angle = 0;  // of the whole cone, from side to side, in degrees
  double blend = 0;  // fraction of the half angle over which it falls off
  /// Radiance: texels finite, not negative; alpha is not used. Of the environment by latitude and longitude:
  /// columns go around +y, and the middle lies towards -z.
  Image map;
  double rotation = 0;  // of the map about +y, in degrees
  int object = -1;      // index into Scene::objects: the surface that it lies on
};

struct CameraSpec {
  // Both camera forms of the file are brought to the thin lens of cl/shared/scene_records.h by device_camera
  // (upload).
  Vec3 origin;
  Vec3 axis{0, 0, -1};  // unit
  Vec3 right, up;       // full film extent at distance 1 along the axis
  double plane_distance = 0;
  double focal_distance = 1;
  double aperture = 0;                  // lens radius
  std::array<double, 2> shutter{0, 1};  // times at which it opens and closes
  bool flat_focus = true;  // the focus is a plane (position/target form) or a sphere (origin/direct form)
};

#define NAME_OF_INTEGRATOR(name, ...) name,
enum class Integrator { INTEGRATOR_TABLE(NAME_OF_INTEGRATOR) };
#undef NAME_OF_INTEGRATOR
enum class Schedule { pixel, global, geometric };
enum class Sampler { sobol, independent };
enum class DirectLight { shadow_rays, photons };

struct RendererSpec {
  Integrator integrator = Integrator::sppm;
  int samples = 64;               // pt: samples per pixel
  int visible_points = 4;         // sppm: per pixel per pass
  std::int64_t photons = 250000;  // sppm: per pass
  int passes = 64;                // sppm
  std::optional<double> radius;   // first search radius; chosen from the scene where absent
  double alpha = 0.7;
  std::optional<double> indirect_radius;  // see indirect_radius()
  bool boundary_correction = true;        // sppm: kernels that reach beyond edges are made up for
  std::optional<bool> guided_photons;     // sppm: copied where they land in view; absent: by the pilot
  std::optional<bool> aimed_photons;      // see aims_photons()
  double radius_decay = 0.95;             // Schedule::geometric
  Schedule schedule = Schedule::pixel;
  Sampler sampler = Sampler::sobol;                     // of camera paths
  DirectLight direct_light = DirectLight::shadow_rays;  // key "direct_light": "shadow_rays" | "photons"
};

/// The radius of indirect photons over that of the others: the scene's own, else 1.
double indirect_radius(const RendererSpec& renderer);

/// What fills all space outside glass.
struct MediumSpec {
  Vec3 absorption, scattering;  // per unit length
  double g = 0;                 // mean cosine of Henyey & Greenstein's phase function
};

struct Scene {
  std::string file;
  std::string output;  // key `path`; empty where absent
  int width = 640, height = 480;
  int max_depth = 16;
  double outside_ior = 1;  // key `Na`
  RendererSpec renderer;
  CameraSpec camera;
  MediumSpec medium;
  std::vector<Object> objects;
  std::vector<LightSpec> lights;  // those that are no objects
  std::vector<MaterialSpec> materials;
  std::vector<TextureSpec> textures;
  std::vector<Image> images;
  std::vector<Mesh> meshes;
  std::vector<std::string> assets;   // every file that was read for it beside its own, each once
  std::vector<std::string> notices;  // what the user should know: ignored keys, fallbacks
};

/// Whether the light gives any light, in the floats that the kernels see.
bool is_lit(const LightSpec& light);

/// Whether the object gives any light: it emits, and has an area.
bool is_lit(const Scene& scene, const Object& object);

/// The largest channel of what an object emits, as a float, which is what the kernels see: the smallest
/// doubles are none.
float emission_of(const Scene& scene, const Object& object);

/// Whether anything in the scene emits light.
bool has_light(const Scene& scene);

/// Whether a ray can meet light: of a surface or a background.
bool has_visible_light(const Scene& scene);

/// Whether light comes from beyond the scene: of a directional light or the environment.
bool has_infinite_light(const Scene& scene);

/// Whether anything moves while the shutter is open.
bool has_motion(const Scene& scene);

/// Whether more photons go where they become caustics (sppm): as the scene says, else where light comes from
/// beyond it (directional lights, the environment), of which most meets nothing that would make one.
bool aims_photons(const Scene& scene);

}  // namespace causticl
