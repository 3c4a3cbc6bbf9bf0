// Photons leave their emitters.
#include "light_fixture.hpp"

using namespace causticl;

namespace {

constexpr std::size_t sample_count = 1 << 20;
using Shape3 = Object::Shape;

cl::Program& program() {
  static cl::Program built = build_test_program(emission_source);
  return built;
}

struct Photons {
  std::vector<float4> origins, directions, fluxes;
};
Photons emit(const Lights& lights) {
  const std::size_t bytes = sample_count * sizeof(float4);
  auto origins = test_device().buffer(bytes, "origins"),
       directions = test_device().buffer(bytes, "directions"), fluxes = test_device().buffer(bytes, "fluxes");
  lights.run("emit", sample_count, origins, directions, fluxes, cl_uint(sample_count), lights.params);
  return {test_device().download<float4>(origins, sample_count),
          test_device().download<float4>(directions, sample_count),
          test_device().download<float4>(fluxes, sample_count)};
}

Histogram flat(const SquareBins& bins) {
  Histogram histogram(bins.count());
  histogram.probabilities.assign(bins.count(), 1.0 / static_cast<double>(bins.count()));
  return histogram;
}

}  // namespace

TEST_CASE("photons leave uniformly over the area, by the cosine law, each channel in proportion") {
  const SquareBins bins{24, 32};
  for (const bool two_sided : {false, true}) {
    // A disc of radius 2 in z = 0, a square, a sphere of radius 3 and a revolved curve.
    for (const Shape3 shape : {Shape3::disk, Shape3::rectangle, Shape3::sphere, Shape3::bezier}) {
      CAPTURE(int(shape), two_sided);
      Scene spec;
      const double radius = shape == Shape3::sphere ? 3 : 2;
      add_light(spec, shape, {}, radius, {1, 4, 2}, two_sided);
      const Photons photons = emit(Lights(spec, program()));
      Histogram places = flat(bins), directions = flat(bins);
      double flux = 0, flux2 = 0;
      std::size_t front = 0, wrong_flux = 0, wrong_start = 0;
      for (std::size_t i = 0; i < sample_count; ++i) {
        const Vec3 p = to_vec3(photons.origins[i]), d = to_vec3(photons.directions[i]),
                   f = to_vec3(photons.fluxes[i]);
        flux += f.y;
        flux2 += f.y * f.y;
        wrong_flux += !(std::fabs(f.x - f.y / 4) < 1e-6 && std::fabs(f.z - f.y / 2) < 1e-6);
        if (shape == Shape3::bezier) continue;
        wrong_flux += !(std::fabs(f.y - 1) < 1e-5);
        const Vec3 normal = shape == Shape3::sphere ? normalize(p) : Vec3{0, 0, 1};
        const double cosine = dot(d, normal), height = shape == Shape3::sphere ? length(p) - radius : p.z;
        front += cosine > 0;
        // Off the surface by about its rounding, on the side that the photon goes to.
        wrong_start += !(std::fabs(height) < 1e-5) || (shape != Shape3::sphere && height * cosine <= 0);
        const Vec3 local = Frame(normal).to_local(d);
        directions.add(bins.bin(cosine * cosine, turn(local.y, local.x)));
        if (shape == Shape3::disk)
          places.add(bins.bin((p.x * p.x + p.y * p.y) / (radius * radius), turn(p.y, p.x)));
        else if (shape == Shape3::rectangle)
          places.add(bins.bin(p.x + 0.5, p.y + 0.5));
        else
          places.add(bins.bin(normal.z / 2 + 0.5, turn(p.y, p.x)));
      }
      // The mean of a curve's flux is 1: what its points lack in uniformity, their flux makes up for.
      const double mean = flux / sample_count,
                   deviation = std::sqrt(std::max(0.0, flux2 / sample_count - mean * mean));
      CHECK(std::fabs(mean - 1) < 1e-4 + 5 * deviation / std::sqrt(sample_count));
      CHECK(wrong_flux == 0);
      if (shape == Shape3::bezier) continue;
      CHECK(wrong_start == 0);
      if (two_sided)
        CHECK(std::fabs(double(front) - sample_count / 2.0) < 5 * std::sqrt(sample_count / 4.0));
      else
        CHECK(front == sample_count);
      check_chi_square(places, light_histograms, "places");
      check_chi_square(directions, light_histograms, "directions");
    }
  }
}
