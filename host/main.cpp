// causticl: the whole flow, one call a line.
#include <chrono>
#include <cstdio>
#include <memory>
#include <new>

#include "compare.hpp"
#include "error.hpp"
#include "explain.hpp"
#include "interruption.hpp"
#include "options.hpp"
#include "output_file.hpp"
#include "progress.hpp"
#include "render_setup.hpp"
#include "report.hpp"
#include "selftest_processes.hpp"
#include "stability_checks.hpp"
#include "view_check.hpp"

namespace {

using namespace causticl;

enum ExitCode { done = 0, fault_of_causticl = 1, fault_of_input = 2, fault_of_device = 3, interrupted = 130 };

std::string size_text(const Picture& picture) {
  return std::to_string(picture.width) + "x" + std::to_string(picture.height) + " pixels";
}

/// Gives `say` what the user should know of the kernels' cache.
template <typename Say>
void report_notices(KernelCache& kernels, const Say& say) {
  for (const auto& notice : kernels.take_notices()) say(notice);
}

/// A line of a command that shows no progress.
void note(const std::string& text) { std::fprintf(stderr, "causticl: note: %s\n", text.c_str()); }

int render(const Options& options) {
  Scene scene = load_scene(options.scene, options.scene_options);
  apply_options(options, scene);
  const auto outputs = output_files(options, scene);
  check_outputs(options, outputs);

  ProgressReport progress(stderr, options.quiet);
  for (const auto& notice : scene.notices) progress.note(notice);
  progress.note(empty_view_notice(scene));
  KernelCache kernels(options.keep_kernels);
  report_notices(kernels, [&](const std::string& notice) { progress.note(notice); });
  std::vector<std::unique_ptr<Device>> opened;
  std::vector<Device*> devices;
  for (const DeviceInfo& info : find_devices(options.device)) {
    progress.note(threads_notice(options, info));
    opened.push_back(std::make_unique<Device>(info, options.threads, &kernels));
    devices.push_back(opened.back().get());
  }

  interruption_listen(options.quiet);
  const RenderResult result = render_scene(
      scene, devices, render_options(options, outputs), [&](const Progress& now) { progress.update(now); },
      [&](const std::string& text) { progress.note(text); }, interruption_requested);

  report_notices(kernels, [&](const std::string& notice) { progress.note(notice); });
  progress.finish(outputs, result.statistics);
  if (options.stats) std::fputs(statistics_table(result.statistics).c_str(), stdout);
  if (!options.stats_json.empty()) write_file(options.stats_json, statistics_json(result.statistics));
  return result.statistics.stop == StopReason::interrupted ? interrupted : done;
}

int explain(const Options& options) {
  if (!options.json.empty()) check_writable(options.json);
  const Scene scene = load_scene(options.scene, options.scene_options);
  Explanation explanation = explain(scene);
  if (options.measure || (scene.renderer.integrator == Integrator::sppm && !list_devices().empty())) {
    KernelCache kernels(options.keep_kernels);
    Device device(find_device(options.device), options.threads, &kernels);
    explain_pilot(explanation, scene, device, render_options(options, {}));
    if (options.measure)
      measure_effects(explanation, scene, device, render_options(options, {}), [](const std::string& effect) {
        std::fprintf(stderr, "causticl: measuring %s\n", effect.c_str());
      });
    report_notices(kernels, note);
  }
  std::fputs(explanation_table(explanation).c_str(), stdout);
  if (!options.json.empty()) write_file(options.json, explanation_json(explanation));
  return done;
}

int selftest(const Options& options) {
  if (!options.json.empty()) check_writable(options.json);
  const auto checks = wanted_checks(stability_checks(), options.selftest);
  const auto start = std::chrono::steady_clock::now();
  SelftestProcesses processes(checks, options.selftest, options.device, options.keep_kernels);
  KernelCache kernels(options.keep_kernels);
  const DeviceInfo device_info = find_device(options.device);
  Device device(device_info, options.threads, &kernels);
  std::fputs(selftest_heading(device_info, options.selftest).c_str(), stdout);
  const auto rows = processes.run(device, [](const SelftestRow& row) {
    std::fputs(selftest_line(row).c_str(), stdout);
    std::fflush(stdout);
  });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report_notices(kernels, note);
  std::fputs(selftest_verdict(rows, options.selftest, seconds).c_str(), stdout);
  if (!options.json.empty())
    write_file(options.json, selftest_json(device_info, rows, options.selftest, seconds));
  return selftest_passed(rows) ? done : fault_of_device;
}

int compare(const Options& options) {
  if (!options.error_map.empty()) check_output(options.error_map);
  if (!options.json.empty()) check_writable(options.json);
  const Picture picture = read_rendered(options.picture), reference = read_rendered(options.reference);
  if (picture.width != reference.width || picture.height != reference.height)
    throw UserError("the pictures differ in size: " + options.picture + " has " + size_text(picture) + ", " +
                    options.reference + " has " + size_text(reference) + "; expected two of one size");
  const Comparison comparison = compare_pictures(picture, reference);
  std::fputs(comparison_table(comparison).c_str(), stdout);
  if (!options.error_map.empty())
    write_picture(options.error_map, error_map(comparison, picture.width, picture.height), {});
  if (!options.json.empty()) write_file(options.json, comparison_json(comparison));
  return done;
}

int study(const Options& options) {
  interruption_listen(options.quiet);
  const auto say = [&](const std::string& line) {
    if (!options.quiet) std::fprintf(stderr, "causticl: %s\n", line.c_str());
  };
  KernelCache kernels(options.keep_kernels);
  const StudyOutcome outcome = run_study(options, kernels, say, interruption_requested);
  report_notices(kernels, say);
  std::fputs(outcome.summary.c_str(), stdout);
  return outcome.interrupted ? interrupted : done;
}

int print(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  return done;
}

int run(const Options& options) {
  switch (options.command) {
    case Options::Command::render:
      return render(options);
    case Options::Command::devices:
      return print(device_list(list_devices()));
    case Options::Command::explain:
      return explain(options);
    case Options::Command::info:
      return print(scene_summary(load_scene(options.scene, options.scene_options)));
    case Options::Command::compare:
      return compare(options);
    case Options::Command::study:
      return study(options);
    case Options::Command::selftest:
      return selftest(options);
    case Options::Command::print:
      break;
  }
  return print(options.text);
}

int fail(const std::string& message, ExitCode code) {
  std::fprintf(stderr, "causticl: error: %s\n", message.c_str());
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(parse_options(argc, argv));
  } catch (const UserError& error) {
    return fail(error.what(), fault_of_input);
  } catch (const DeviceError& error) {
    return fail(error.what(), fault_of_device);
  } catch (const cl::Error& error) {
    return fail(
        "the OpenCL call " + std::string(error.what()) + " failed with " + std::to_string(error.err()),
        fault_of_device);
  } catch (const std::bad_alloc&) {
    return fail("out of memory; a smaller --size or --photons needs less", fault_of_device);
  } catch (const std::exception& error) {
    return fail(std::string("unexpected: ") + error.what(), fault_of_causticl);
  }
}
