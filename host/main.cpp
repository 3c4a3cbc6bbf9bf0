// causticl: the whole flow, one call a line.
#include <chrono>
#include <memory>
#include <new>
#include <sstream>

#include "accuracy/compare.hpp"
#include "app/film_setup.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/render_setup.hpp"
#include "app/report.hpp"
#include "base/console.hpp"
#include "base/distinct_files.hpp"
#include "base/error.hpp"
#include "base/interruption.hpp"
#include "base/output_file.hpp"
#include "base/spelling.hpp"
#include "device_scene/channel_shifts.hpp"
#include "film/merge_films.hpp"
#include "format/load_scene.hpp"
#include "format/scene_output.hpp"
#include "format/scene_schema.hpp"
#include "render/explain.hpp"
#include "render/film_picture.hpp"
#include "scene/integrators.hpp"
#include "selftest/selftest_processes.hpp"
#include "selftest/stability_checks.hpp"
#include "world/view_check.hpp"

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
void note(const std::string& text) { print_message(stderr, "note: " + text); }

int fail(const std::string& message, ExitCode code) {
  print_message(stderr, "error: " + message);
  return code;
}

/// The last steps of a command, of which each is taken also where another fails.
class LastSteps {
 public:
  template <typename Step>
  void take(const Step& step) try {
    step();
  } catch (const UserError& error) {
    failed(error.what());
  }
  /// A fault that two steps meet is told once.
  void failed(const std::string& fault) {
    if (fault != last_fault_) code_ = fail(fault, fault_of_input);
    last_fault_ = fault;
  }

  /// `code` where all went well.
  int exit_code(int code = done) const { return code_ == done ? code : code_; }

 private:
  int code_ = done;
  std::string last_fault_;
};

void write_json(const std::string& file, const std::string& text) {
  if (!file.empty()) write_file(file, text);
}

std::vector<std::string> written(std::vector<std::string> outputs,
                                 const std::vector<UnwrittenPicture>& unwritten) {
  for (const auto& [file, fault] : unwritten) std::erase(outputs, file);
  return outputs;
}

int render(const Options& options) {
  Scene scene = load_scene(options.scene, options.scene_options);
  apply_options(options, scene);
  RenderOptions render = options.render;
  render.outputs = output_files(options, scene);
  check_outputs(options, render.outputs);
  set_film(options, scene, render);

  ProgressReport progress(stderr, options.quiet);
  for (const auto& notice : scene.notices) progress.note(notice);
  if (options.render.outputs.empty()) progress.note(scene_output(scene).notice);
  progress.note(empty_view_notice(scene));
  if (traces_photons(scene.renderer.integrator))
    for (const auto& notice : coarse_channel_notices(scene)) progress.note(notice);
  KernelCache kernels(options.keep_kernels);
  report_notices(kernels, [&](const std::string& notice) { progress.note(notice); });
  std::vector<std::unique_ptr<Device>> opened;
  std::vector<Device*> devices;
  for (const DeviceInfo& info : find_devices(options.device)) {
    progress.note(threads_notice(options, info));
    opened.push_back(std::make_unique<Device>(info, render.threads, &kernels));
    devices.push_back(opened.back().get());
  }

  interruption_listen(options.quiet);
  const RenderResult result = render_scene(
      scene, devices, render, [&](const Progress& now) { progress.update(now); },
      [&](const std::string& text) { progress.note(text); }, interruption_requested);

  report_notices(kernels, [&](const std::string& notice) { progress.note(notice); });
  progress.finish(written(render.outputs, result.unwritten), result.statistics);
  LastSteps last;
  for (const auto& [file, fault] : result.unwritten) last.failed(fault);
  last.take([&] { write_json(options.stats_json, statistics_json(result.statistics)); });
  if (options.stats) last.take([&] { print_output(statistics_table(result.statistics)); });
  return last.exit_code(result.statistics.stop == StopReason::interrupted ? interrupted : done);
}

/// Writes the picture of all parts.
void merge_picture(const Options& options, const FilmMerger& merger, ProgressReport& progress,
                   LastSteps& last) {
  KernelCache kernels(options.keep_kernels);
  Device device(find_device(options.device), options.render.threads, &kernels);
  const RenderResult result = picture_of(merger, device, options.render.confidence);
  report_notices(kernels, [&](const std::string& notice) { progress.note(notice); });
  const auto unwritten = write_pictures(options.render.outputs, result.picture,
                                        metadata_of(merger.summary(), result.statistics), Unwritable::kept);
  progress.finish(written(options.render.outputs, unwritten), result.statistics);
  for (const auto& [file, fault] : unwritten) last.failed(fault);
}

int merge(const Options& options) {
  for (const auto& file : options.render.outputs) check_output(file);
  if (!options.film.empty()) check_film_place(options.film);
  std::vector<NamedFile> files{{"the film of the whole", options.film}};
  for (const auto& file : options.render.outputs) files.push_back({"a picture", file});
  check_distinct(files);
  // The film of the whole may take the place of one of the parts: it is written last.
  files.erase(files.begin());
  for (const auto& file : options.films) files.push_back({"a part", file});
  check_distinct(files);
  FilmMerger merger;
  for (const auto& file : options.films) merger.add(file);
  const FilmState film = merger.summary();
  ProgressReport progress(stderr, options.quiet);
  if (film.devices.size() > 1)
    progress.note("the parts are of " + listed(film.devices) + ": the bits are those of no single device");
  LastSteps last;
  if (!options.render.outputs.empty()) last.take([&] { merge_picture(options, merger, progress, last); });
  if (!options.film.empty()) last.take([&] { write_film(options.film, merger.whole()); });
  return last.exit_code();
}

int explain(const Options& options) {
  if (!options.json.empty()) check_writable(options.json);
  const Scene scene = load_scene(options.scene, options.scene_options);
  Explanation explanation = explain(scene);
  if (options.measure || (traces_photons(scene.renderer.integrator) && !list_devices().empty())) {
    KernelCache kernels(options.keep_kernels);
    Device device(find_device(options.device), options.render.threads, &kernels);
    explain_pilot(explanation, scene, device, options.render);
    if (options.measure)
      measure_effects(explanation, scene, device, options.render,
                      [](const std::string& effect) { print_message(stderr, "measuring " + effect); });
    report_notices(kernels, note);
  }
  LastSteps last;
  last.take([&] { write_json(options.json, explanation_json(explanation)); });
  last.take([&] { print_output(explanation_table(explanation)); });
  return last.exit_code();
}

int selftest(const Options& options) {
  if (!options.json.empty()) check_writable(options.json);
  const auto checks = wanted_checks(stability_checks(), options.selftest);
  const auto start = std::chrono::steady_clock::now();
  SelftestProcesses processes(checks, options.selftest, options.device, options.keep_kernels);
  KernelCache kernels(options.keep_kernels);
  const DeviceInfo device_info = find_device(options.device);
  Device device(device_info, options.selftest.threads, &kernels);
  print_output(selftest_heading(device_info, options.selftest));
  const auto rows = processes.run(device, [](const SelftestRow& row) { print_output(selftest_line(row)); });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  report_notices(kernels, note);
  LastSteps last;
  last.take([&] { write_json(options.json, selftest_json(device_info, rows, options.selftest, seconds)); });
  last.take([&] { print_output(selftest_verdict(rows, options.selftest, seconds)); });
  return selftest_passed(rows) ? last.exit_code() : fault_of_device;
}

int compare(const Options& options) {
  if (!options.error_map.empty()) check_output(options.error_map);
  if (!options.json.empty()) check_writable(options.json);
  const ImageLimits& limits = options.scene_options.image_limits;
  const Picture picture = read_rendered(options.picture, limits);
  const Picture reference = read_rendered(options.reference, limits.after(picture.rgb.size() / 3));
  if (picture.width != reference.width || picture.height != reference.height)
    throw UserError("the pictures differ in size: " + options.picture + " has " + size_text(picture) + ", " +
                    options.reference + " has " + size_text(reference) + "; expected two of one size");
  Comparison comparison = compare_pictures(picture, reference);
  take_off_noise(comparison, reference);
  LastSteps last;
  if (!options.error_map.empty())
    last.take(
        [&] { write_picture(options.error_map, error_map(comparison, picture.width, picture.height), {}); });
  last.take([&] { write_json(options.json, comparison_json(comparison)); });
  last.take([&] { print_output(comparison_table(comparison)); });
  return last.exit_code();
}

int study(const Options& options) {
  interruption_listen(options.quiet);
  const auto say = [&](const std::string& line) {
    if (!options.quiet) print_message(stderr, line);
  };
  KernelCache kernels(options.keep_kernels);
  const StudyRequest request{options.scene, options.scene_options, options.study, options.render,
                             options.device};
  const StudyOutcome outcome = run_study(request, kernels, say, interruption_requested);
  report_notices(kernels, say);
  print_output(outcome.summary);
  return outcome.interrupted ? interrupted : done;
}

int print(const std::string& text) {
  print_output(text);
  return done;
}

int run(const Options& options) {
  switch (options.command) {
    case Options::Command::render:
      return render(options);
    case Options::Command::merge:
      return merge(options);
    case Options::Command::devices:
      return print(device_list(list_devices()));
    case Options::Command::explain:
      return explain(options);
    case Options::Command::info:
      return print(scene_summary(load_scene(options.scene, options.scene_options)));
    case Options::Command::schema:
      return print(scene_schema());
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

/// The first line of `message`, and the log of a compiler that may follow it.
int fail_with_log(const std::string& message, ExitCode code) {
  std::istringstream lines(message);
  std::string line;
  for (bool first = true; std::getline(lines, line); first = false)
    print_message(stderr, first ? "error: " + line : "  " + line);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  console_start();
  try {
    return run(parse_options(argc, argv));
  } catch (const UserError& error) {
    return fail(error.what(), fault_of_input);
  } catch (const DeviceError& error) {
    return fail_with_log(error.what(), fault_of_device);
  } catch (const cl::Error& error) {
    return fail(
        "the OpenCL call " + std::string(error.what()) + " failed with " + std::to_string(error.err()),
        fault_of_device);
  } catch (const Interrupted&) {
    return fail("interrupted before the first pass; there is no picture yet", interrupted);
  } catch (const std::bad_alloc&) {
    return fail("out of memory; a smaller --size or --photons needs less", fault_of_device);
  } catch (const std::exception& error) {
    return fail(std::string("unexpected: ") + error.what(), fault_of_causticl);
  }
}
