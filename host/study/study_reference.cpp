// The picture that a study measures errors against.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "accuracy/compare.hpp"
#include "base/error.hpp"
#include "effects/effects.hpp"
#include "scene/material_kind.hpp"
#include "shared/effects.h"
#include "study/study_session.hpp"

namespace causticl {
namespace {

/// Of each half, also where start-up has taken what the budget had for the reference: two pictures of hardly
/// a sample do not tell their noise.
constexpr int fewest_passes = 16;

/// Seeds that no measured render uses: a reference must be independent of what it is compared with.
std::uint32_t reference_seed(std::uint32_t seed, std::uint32_t half) { return ~seed - half; }

/// The mean of a picture that errors can be relative to. Throws UserError for a black one.
double usable_mean(const Picture& picture, const std::string& name) {
  double sum = 0;
  for (const float value : picture.rgb) sum += value;
  const double mean = sum / static_cast<double>(picture.rgb.size());
  if (!(mean > 0) || !std::isfinite(mean))
    throw UserError(name +
                    ": black or not finite; expected a picture with light, which errors are relative to");
  return mean;
}

void read_given(StudySession& session) {
  const std::string& file = session.request.study.reference;
  const Study& study = session.study;
  session.reference = read_rendered(file, session.request.scene_options.image_limits);
  const auto size = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  if (session.reference.width != study.width || session.reference.height != study.height)
    throw UserError("--reference " + file + ": has " +
                    size(session.reference.width, session.reference.height) + " pixels; expected " +
                    size(study.width, study.height) + ", or another --size");
  StudyReference reference{"the file " + file + ", whose own error is not known", 0, 0,
                           usable_mean(session.reference, "--reference " + file), 0};
  if (const auto noise = noise_of(session.reference)) {
    reference.how = "the file " + file + ", whose noise its channels error.* tell";
    reference.relative_mse = noise->mse / (reference.mean * reference.mean);
    reference.error_90 = noise->error_90;
  }
  session.study.reference = reference;
}

/// How to render a reference. Where every surface is diffuse, path tracing finds all light and blurs none;
/// elsewhere photon mapping does better, with half the first radius so that it blurs less.
StudySetting reference_setting(StudySession& session) {
  const RenderSetup setup = session.renderer.setup_of(session.own_change);
  constexpr unsigned not_diffuse = effects_of_kinds(REFLECTS | TRANSMITS) | EFFECT_ROUGH;
  const unsigned effects = effect_bits(find_effects(setup.scene));
  if (!(effects & not_diffuse) || session.study.first_radius == 0)
    return {"reference", "", integrator_change(Integrator::pt), true};
  RenderChange change = integrator_change(Integrator::sppm);
  for (const auto& [key, value] : {std::pair{"schedule", std::string("global")},
                                   {"alpha", "0.6667"},
                                   {"indirect_radius", "1"},
                                   {"radius", short_number(session.study.first_radius / 2)}})
    change = merged(change, renderer_change(key, value));
  return {"reference", "", change, false};
}

std::string description(const StudySetting& setting, unsigned long long passes) {
  if (setting.path_traced) return "path tracing with " + std::to_string(passes) + " samples a pixel";
  return "photon mapping with " + std::to_string(passes) +
         " passes, the global schedule, alpha 2/3 and half the first radius for all light (what little it "
         "blurs is not in "
         "its noise)";
}

}  // namespace

void make_reference(StudySession& session) {
  Study& study = session.study;
  const std::string file = session.path("reference.exr");
  if (!session.request.study.reference.empty()) return read_given(session);
  if (study.reference && std::filesystem::exists(file)) {
    session.reference = read_rendered(file);
    return;
  }

  // Two independent halves: the variance of their difference tells that of their mean.
  const StudySetting setting = reference_setting(session);
  std::array<MeasuredRender, 2> halves;
  for (std::uint32_t half = 0; half < 2; ++half) {
    const double end = session.spent() + (session.budget.reference_end() - session.spent()) / (2 - half);
    char text[64];
    std::snprintf(text, sizeof text, "reference, half %u of 2: %.0f s", half + 1,
                  std::max(0.0, end - session.spent()));
    session.say(text);
    int passes_done = 0;
    halves[half] = session.renderer.render(
        setting, reference_seed(study.seed, half), nullptr, [&](const RenderState& now) {
          const bool enough =
              ++passes_done >= fewest_passes || session.spent() > session.budget.short_runs_end();
          return session.interrupted() || (enough && session.spent() + now.last_pass > end);
        });
    if (session.interrupted()) return;
  }
  const auto passes = halves[0].passes + halves[1].passes;
  const double weight = static_cast<double>(halves[1].passes) / static_cast<double>(passes);
  Picture mean = halves[0].picture;
  for (std::size_t i = 0; i < mean.rgb.size(); ++i)
    mean.rgb[i] = static_cast<float>((1 - weight) * mean.rgb[i] + weight * halves[1].picture.rgb[i]);

  StudyReference reference;
  reference.how = description(setting, passes);
  reference.mean = usable_mean(mean, session.request.scene);
  // Var((1-w) A + w B) = w (1-w) Var(A - B), where the variance of either is as one over its passes.
  const double factor = weight * (1 - weight);
  const Comparison apart = compare_pictures(halves[0].picture, halves[1].picture);
  reference.relative_mse = factor * apart.mse / (reference.mean * reference.mean);
  reference.error_90 = std::sqrt(factor) * relative_error_quantile(halves[0].picture, halves[1].picture, 0.9);
  reference.seconds = halves[0].seconds + halves[1].seconds;
  write_picture(file, mean, {{"scene", study.scene}, {"reference", reference.how}});
  session.reference = std::move(mean);
  study.reference = reference;
  session.save();
  session.say("reference: " + reference.how + "; its noise is a relative RMSE of " +
              short_number(100 * std::sqrt(reference.relative_mse)) + "%");
}

}  // namespace causticl
