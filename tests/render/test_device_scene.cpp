// What is uploaded, read back.
#include <CL/cl_half.h>

#include <cmath>

#include "device_fixture.hpp"
#include "device_scene/device_scene.hpp"

using namespace causticl;

TEST_CASE("texels reach the device as the nearest halfs") {
  Scene scene;
  scene.objects.push_back({});
  scene.materials.push_back({});
  RandomInputs random(20);
  Image image;
  image.width = 64;
  image.height = 1;
  image.rgba = {0.0f,  -0.0f,         1.0f,    0.5f,   1.0f / 255,  65504.0f,
                1e-9f, 6.1035156e-5f, 3.0e-6f, -0.25f, 254.0f / 255};
  while (image.rgba.size() < 256)
    image.rgba.push_back(static_cast<float>(std::exp2(random.uniform(-26, 16))));
  scene.images.push_back(image);
  scene.textures.emplace_back().image = 0;
  scene.materials[0].color_texture = 0;

  const DeviceScene uploaded = update_device_scene(scene, test_device());
  const auto texels = test_device().download<cl_half>(uploaded.texels, image.rgba.size());
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const float value = image.rgba[i], half = cl_half_to_float(texels[i]);
    INFO("seed " << random.seed << ", value " << value << ", half " << half);
    // Half a unit in the last of eleven bits; 2^-25 below the normal numbers.
    const double bound = std::fmax(std::ldexp(std::fabs(value), -11), std::ldexp(1.0, -25));
    CHECK(std::fabs(static_cast<double>(value) - half) <= bound);
  }
}

TEST_CASE("texels that are not finite reach the device as such, to be counted there") {
  Scene scene;
  scene.objects.push_back({});
  scene.materials.push_back({});
  scene.images.push_back({"", 1, 1, {NAN, INFINITY, -INFINITY, 1e6f}});
  scene.textures.emplace_back().image = 0;
  scene.materials[0].color_texture = 0;
  const auto texels = test_device().download<cl_half>(update_device_scene(scene, test_device()).texels, 4);
  CHECK(std::isnan(cl_half_to_float(texels[0])));
  CHECK(cl_half_to_float(texels[1]) == INFINITY);
  CHECK(cl_half_to_float(texels[2]) == -INFINITY);
  CHECK(cl_half_to_float(texels[3]) == 65504.0f);
}
