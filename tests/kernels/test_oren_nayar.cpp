// Rough diffuse surfaces against the model EON in double precision, and how photons are weighed by it.
#include "vector_inputs.hpp"

using namespace causticl;

namespace {

const char* const source = R"(
#include "materials/adjoint_bsdf.cl"
#include "photons/gather_weighted.cl"
typedef struct {
  float4 wi, wo;  // w of wi: roughness
  float4 color;
} Input;
INLINE Bsdf bsdf_of(Input in) {
  Bsdf bsdf = {MATERIAL_OREN_NAYAR, convert_real3(in.color.xyz), 1};
  bsdf.own = in.wi.w;
  return bsdf;
}
kernel void value(global const Input *in, global float4 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Bsdf bsdf = bsdf_of(in[i]);
  real3 over = over_lambert(&bsdf, convert_real3(in[i].wi.xyz), convert_real3(in[i].wo.xyz), (real3)(0, 0, 1));
  out[i] = (float4)(convert_float3(over), 0);
}
// What sampling draws, by camera paths and by photons at an even surface: direction and weight.
kernel void sample(global const Input *in, global float8 *out, uint count) {
  uint i = get_global_id(0);
  if (i >= count) return;
  Bsdf bsdf = bsdf_of(in[i]);
  Surface surface = {(real3)(0, 0, 0), (real3)(0, 0, 1), (real3)(0, 0, 1), (real2)(0, 0), 0, 0};
  real3 d = convert_real3(in[i].wi.xyz);
  real4 random = convert_real4(in[i].wo);
  BsdfSample path = bsdf_sample(&bsdf, &surface, d, random, true), photon = adjoint_bsdf_sample(&bsdf, &surface, d, random);
  out[2 * i] = (float8)(convert_float3(path.direction), path.pdf, convert_float3(path.weight), 0);
  out[2 * i + 1] = (float8)(convert_float3(photon.direction), photon.pdf, convert_float3(photon.weight), 0);
}
// The sums that a lobe makes of eight photons of flux 60000, 30000, 15000 that arrive along wi, each with a dither of its own.
kernel void gather_lobe(global const Input *in, global float4 *out, uint count, global PhotonBlock *blocks) {
  uint i = get_global_id(0);
  if (i >= count) return;
  global PhotonBlock *block = blocks + i;
  for (uint lane = 0; lane < 8; ++lane) {
    block->position[0][lane] = block->position[1][lane] = block->position[2][lane] = 0;
    block->normal[lane] = normal_pack((real3)(0, 0, 1));
    block->flux_rg[lane] = 60000u | 30000u << 16;
    real2 dither = (real2)((lane % 2 + (real)0.5f) / 2, (lane / 2 + (real)0.5f) / 4);
    uint layer = lane % LIGHT_PASS_COUNT << PHOTON_LIGHT_PASS_SHIFT;
    block->flux_b[lane] = 15000u | layer |
                          direction_pack_dithered(convert_real3(in[i].wi.xyz), dither) << PHOTON_DIRECTION_SHIFT;
  }
  Bsdf bsdf = bsdf_of(in[i]);
  VisibleLobe lobe = visible_lobe(&bsdf, -convert_real3(in[i].wo.xyz), (real3)(0, 0, 1));
  GatherPoint point = gather_point((real3)(0, 0, 0), normal_pack((real3)(0, 0, 1)), 1);
  point.lobe = &lobe;
  Gathered sum = gathered_none();
  gather_range_lobe(block, 0, 8, &point, 0, &sum);
  out[i] = (float4)(sum.red / (8 * 60000 * LOBE_UNIT), sum.green / (8 * 30000 * LOBE_UNIT),
                    sum.blue / (8 * 15000 * LOBE_UNIT), sum.count);
}
)";

struct Input {
  float4 wi, wo, color;
};

cl::Program& program() {
  static cl::Program built = build_test_program(source);
  return built;
}

/// Reflectance of a white surface by one bounce (Portsmouth, Kutz & Hill 2025, equation 22 and appendix), as
/// the integral of Fujii's model in closed form.
double single_albedo(double cosine, double r) {
  const double theta = std::acos(cosine), sine = std::sin(theta);
  const double g =
      sine * (theta - sine * cosine) + 2.0 / 3 * (sine / cosine * (1 - sine * sine * sine) - sine);
  return (1 + r * g / M_PI) / (1 + (0.5 - 2 / (3 * M_PI)) * r);
}

/// EON over Lambert for light that arrives along `wi` and leaves along `wo`, the normal z.
double eon(Vec3 wi, Vec3 wo, double r, double color) {
  const double in = -wi.z, out = wo.z, s = -dot(wi, wo) - in * out;
  const double a = 1 / (1 + (0.5 - 2 / (3 * M_PI)) * r);
  const double mean = a * (1 + (2.0 / 3 - 28 / (15 * M_PI)) * r);
  const double single = a * (1 + r * (s > 0 ? s / std::max(in, out) : s));
  if (r == 0) return 1;
  const double several = color * mean / (1 - color * (1 - mean));
  return single + several * (1 - single_albedo(in, r)) * (1 - single_albedo(out, r)) / (1 - mean);
}

/// A direction of that cosine with z.
Vec3 direction_at(double cosine, double turn) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(turn), sine * std::sin(turn), cosine};
}

std::vector<Input> inputs(std::size_t count, double least_cosine) {
  RandomInputs random(2901);
  std::vector<Input> result;
  for (std::size_t i = 0; i < count; ++i) {
    const auto direction = [&] {
      return direction_at(random.uniform(least_cosine, 1), random.uniform(0, 2 * M_PI));
    };
    const float r = i % 7 ? static_cast<float>(random.uniform()) : static_cast<float>(i % 2);
    const auto color = [&] {
      return i % 5 ? static_cast<float>(random.uniform()) : (random.uniform() < 0.5 ? 1.0f : 0.0f);
    };
    result.push_back({to_float4(-direction(), r), to_float4(direction()), {color(), color(), color(), 0}});
  }
  return result;
}

}  // namespace

TEST_CASE("a rough diffuse surface reflects as EON says, both ways alike") {
  const auto in = inputs(200000, 0.01);
  auto turned = in;
  for (std::size_t i = 0; i < in.size(); ++i) {
    turned[i].wi = to_float4(-to_vec3(in[i].wo), in[i].wi.w);
    turned[i].wo = to_float4(-to_vec3(in[i].wi));
  }
  const auto out = outputs_of<float4>(program(), "value", in),
             back = outputs_of<float4>(program(), "value", turned);
  double worst = 0, worst_turned = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const float colors[]{in[i].color.x, in[i].color.y, in[i].color.z}, found[]{out[i].x, out[i].y, out[i].z},
        other[]{back[i].x, back[i].y, back[i].z};
    for (int c = 0; c < 3; ++c) {
      const double exact = eon(to_vec3(in[i].wi), to_vec3(in[i].wo), in[i].wi.w, colors[c]);
      worst = std::max(worst, std::fabs(found[c] - exact) / (1 + exact));
      worst_turned = std::max(worst_turned, std::fabs(double(found[c]) - other[c]) / (1 + exact));
    }
  }
  INFO("worst " << worst << ", turned " << worst_turned);
  CHECK(worst < 2e-5);
  CHECK(worst_turned < 2e-6);
}

TEST_CASE("a white rough diffuse surface reflects all light, a grey one no more than Lambert's") {
  constexpr int steps = 512;
  for (const float r : {0.0f, 0.3f, 1.0f})
    for (const double cosine : {0.05, 0.3, 0.7, 1.0})
      for (const float color : {0.5f, 1.0f}) {
        std::vector<Input> in;
        for (int i = 0; i < steps; ++i)
          for (int k = 0; k < steps; ++k)
            in.push_back({to_float4(-direction_at(cosine, 0.1), r),
                          to_float4(direction_at(std::sqrt((i + 0.5) / steps), 2 * M_PI * (k + 0.5) / steps)),
                          {color, color, color, 0}});
        double albedo = 0;
        for (const float4& over : outputs_of<float4>(program(), "value", in)) albedo += over.x;
        albedo *= color / (double(steps) * steps);
        INFO("roughness " << r << ", cosine " << cosine);
        if (color == 1) {
          CHECK(albedo == Approx(1).epsilon(1e-4));
        } else {
          CHECK(albedo < color + 1e-4);
        }
      }
}

TEST_CASE("rough diffuse surfaces are sampled by the cosine, with the BSDF as weight") {
  RandomInputs random(2902);
  auto in = inputs(100000, 0.02);
  for (auto& input : in) input.wo = {uniform24(random), uniform24(random), uniform24(random), 0};
  struct Sample {
    float4 direction, weight;
  };
  const auto half = test_device().buffer(in.size() * 2 * sizeof(Sample), "outputs");
  run_kernel(program(), "sample", in.size(), test_device().upload(in, "inputs"), half, cl_uint(in.size()));
  const auto out = test_device().download<Sample>(half, 2 * in.size());
  std::size_t wrong_pdf = 0, wrong_weight = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Input& input = in[i / 2];
    const auto& [direction, weight] = out[i];
    const Vec3 wo = to_vec3(direction);
    wrong_pdf += !(std::fabs(direction.w - wo.z / M_PI) < 1e-6);
    if (wo.z < 0.01) continue;
    const float colors[]{input.color.x, input.color.y, input.color.z}, found[]{weight.x, weight.y, weight.z};
    for (int c = 0; c < 3; ++c) {
      const double exact = colors[c] * eon(to_vec3(input.wi), wo, input.wi.w, colors[c]);
      wrong_weight += !(std::fabs(found[c] - exact) <= 1e-4 * (1 + exact));
    }
  }
  CHECK(wrong_pdf == 0);
  CHECK(wrong_weight == 0);
}

TEST_CASE("photons on a rough diffuse surface are weighed by where they came from") {
  const auto in = inputs(20000, 0.2);
  const auto blocks = test_device().buffer(in.size() * sizeof(PhotonBlock), "photons");
  const auto out = outputs_of<float4>(program(), "gather_lobe", in, blocks);
  double worst = 0, bias = 0;
  std::size_t wrong_count = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const float colors[]{in[i].color.x, in[i].color.y, in[i].color.z}, found[]{out[i].x, out[i].y, out[i].z};
    wrong_count += out[i].w != 8;
    for (int c = 0; c < 3; ++c) {
      const double exact = eon(to_vec3(in[i].wi), to_vec3(in[i].wo), in[i].wi.w, colors[c]);
      worst = std::max(worst, std::fabs(found[c] / exact - 1));
      bias += (found[c] / exact - 1) / (3.0 * static_cast<double>(in.size()));
    }
  }
  INFO("worst " << worst << ", bias " << bias);
  CHECK(wrong_count == 0);
  // Two by four strata of the dither leave up to a quarter of a step, which is 1.3 degrees or 0.02 radians;
  // where cosines are 0.2 the factor changes by up to five times that, and more where it is small.
  CHECK(worst < 0.05);
  CHECK(std::fabs(bias) < 3e-4);
}
