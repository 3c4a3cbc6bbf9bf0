// What `info` tells of a scene.
#include "app/report.hpp"
#include "catch2.hpp"
#include "report_fixture.hpp"

using namespace causticl;
using Catch::Contains;

namespace {

Object object_at(Object::Shape shape, Vec3 position) {
  Object object;
  object.shape = shape;
  object.pointer = "/objects/0";
  object.transform = Transform::shift(position);
  return object;
}

}  // namespace

TEST_CASE("a scene's summary counts its objects and finds its emitters") {
  Scene scene = example_scene();
  scene.meshes.resize(1);
  scene.meshes[0].file = "bunny.obj";
  scene.meshes[0].positions = {{1, 2, 3}};
  scene.meshes[0].position_index.resize(12);
  scene.objects = {object_at(Object::Shape::mesh, {}), object_at(Object::Shape::mesh, {}),
                   object_at(Object::Shape::plane, {}), object_at(Object::Shape::sphere, {1, 2, 3})};
  scene.objects[0].mesh = scene.objects[1].mesh = 0;
  scene.objects[3].material = 1;
  scene.notices = {"look here"};
  const std::string text = scene_summary(scene);
  CHECK_THAT(text, Contains("320 x 200") && Contains("4: 2 meshes, 1 plane, 1 sphere"));
  CHECK_THAT(text, Contains("bunny.obj: 12 triangles, used 2 times") && Contains("1 diffuse, 1 glass"));
  CHECK_THAT(text, Contains("emitters    1\n  /objects/0: sphere, radiance (0, 3, 0)"));
  CHECK_THAT(text, Contains("field of view 90 degrees") && Contains("note        look here"));
  CHECK_THAT(text, Contains("bounds      (0, 1, 2) to (2, 3, 4)"));
}

TEST_CASE("a scene's summary bounds every shape as it is transformed") {
  Scene scene = example_scene();
  const auto bounds_of = [&](Object object) {
    scene.objects = {object};
    const std::string text = scene_summary(scene);
    const auto start = text.find("bounds ");
    return text.substr(start, text.find('\n', start) - start);
  };
  Object object = object_at(Object::Shape::sphere, {});
  object.radius = 2;
  object.transform = Transform::scale({1, 2, 3}).followed_by(Transform::shift({10, 0, 0}));
  CHECK_THAT(bounds_of(object), Contains("(8, -4, -6) to (12, 4, 6)"));
  object = object_at(Object::Shape::disk, {1, 1, 1});
  CHECK_THAT(bounds_of(object), Contains("(0, 0, 1) to (2, 2, 1)"));
  object = object_at(Object::Shape::rectangle, {1, 1, 1});
  CHECK_THAT(bounds_of(object), Contains("(0.5, 0.5, 1) to (1.5, 1.5, 1)"));
  object = object_at(Object::Shape::box, {0, 0, 0});
  object.size = {2, 4, 6};
  CHECK_THAT(bounds_of(object), Contains("(-1, -2, -3) to (1, 2, 3)"));
  object = object_at(Object::Shape::bezier, {0, 1, 0});
  object.points = {{1, 0}, {3, 2}, {0, 4}};
  CHECK_THAT(bounds_of(object), Contains("(-3, 1, -3) to (3, 5, 3)"));
  CHECK_THAT(bounds_of(object_at(Object::Shape::plane, {})), Contains("none: every object is infinite"));
}
