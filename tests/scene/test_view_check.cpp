// Whether the camera is said to see nothing exactly where it does.
#include "catch2.hpp"

#include "render/render_fixture.hpp"
#include "world/view_check.hpp"

using namespace causticl;

namespace {

std::string notice_of(const std::string& objects,
                      const std::string& camera = R"("position": [0, 0, 5], "target": [0, 0, 0])") {
  return empty_view_notice(scene_from_text(
      R"({"width": 16, "height": 12, "camera": {"fov": 40, )" + camera +
      R"(}, "materials": {"m": {"type": "diffuse", "color": [1, 1, 1]}}, "objects": [)" + objects + "]}"));
}

std::string ball(const std::string& place) {
  return R"({"type": "sphere", "radius": 1, "material": "m", "transform": [{"type": "shift", )" + place +
         "}]}";
}

}  // namespace

TEST_CASE("a camera that sees no object is told of, and one that sees a corner of it is not") {
  CHECK(notice_of(ball(R"("x": 0, "y": 0, "z": 0)")).empty());
  CHECK(!notice_of(ball(R"("x": 0, "y": 0, "z": 9)")).empty());  // behind
  CHECK(!notice_of(ball(R"("x": 0, "y": 5, "z": 0)")).empty());  // above: the view is 1.8 high on either side
  CHECK(notice_of(ball(R"("x": 0, "y": 2.5, "z": 0)")).empty());
  const std::string box =
      R"({"type": "box", "size": [1, 1, 1], "material": "m", "transform": [{"type": "shift", "x": )";
  CHECK(!notice_of(box + R"(4, "y": 0, "z": 0}]})").empty());
  CHECK(notice_of(box + R"(2.6, "y": 0, "z": 0}]})").empty());
}

TEST_CASE("an infinite plane is seen wherever some ray of the view meets it") {
  const std::string floor =
      R"({"type": "plane", "material": "m", "transform": [{"type": "rotate", "axis": "x", "degree": -90}, {"type": "shift", "x": 0, "y": -1, "z": 0}]})";
  CHECK(notice_of(floor).empty());
  CHECK(!notice_of(floor, R"("position": [0, 0, 5], "target": [0, 3, 0])")
             .empty());  // up, by more than half the view
  CHECK(notice_of(floor, R"("position": [0, 0, 5], "target": [0, 1, 0])").empty());
  CHECK(notice_of(floor, R"("position": [0, -3, 5], "target": [0, 0, 0])").empty());  // from below
}
