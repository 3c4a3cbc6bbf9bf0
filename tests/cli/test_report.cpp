// What is told to the user: numbers, statistics and devices.
#include <cstdio>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/progress.hpp"
#include "app/report.hpp"
#include "catch2.hpp"
#include "report_fixture.hpp"

using namespace causticl;
using Catch::Contains;
using Catch::StartsWith;

namespace {}  // namespace

TEST_CASE("numbers are printed with three figures and a prefix") {
  CHECK(si_number(0) == "0");
  CHECK(si_number(999) == "999");
  CHECK(si_number(999.6) == "1.00 k");
  CHECK(si_number(12345) == "12.3 k");
  CHECK(si_number(999499) == "999 k");
  CHECK(si_number(999600) == "1.00 M");
  CHECK(si_number(4.56e6) == "4.56 M");
  CHECK(si_number(7.8e9) == "7.80 G");
}

TEST_CASE("times are printed as on a clock") {
  CHECK(clock_time(0) == "0:00");
  CHECK(clock_time(59.4) == "0:59");
  CHECK(clock_time(59.6) == "1:00");
  CHECK(clock_time(754) == "12:34");
  CHECK(clock_time(3723) == "1:02:03");
  CHECK(clock_time(-1) == "?");
  CHECK(clock_time(std::numeric_limits<double>::infinity()) == "?");
}

TEST_CASE("sizes are printed in binary units") {
  CHECK(byte_size(0) == "0 B");
  CHECK(byte_size(1023) == "1023 B");
  CHECK(byte_size(1536) == "1.50 KiB");
  CHECK(byte_size(3.0 * (1 << 30)) == "3.00 GiB");
}

TEST_CASE("the error is told with its confidence and its parts, and is null where it is not known") {
  Statistics statistics = example_statistics();
  const auto last_lines = [&] {
    return printed([&](std::FILE* stream) { ProgressReport(stream, false).finish({"a.png"}, statistics); });
  };
  CHECK_THAT(last_lines(), !Contains("error"));
  CHECK(nlohmann::json::parse(statistics_json(statistics))["error"].is_null());
  CHECK_THAT(statistics_table(statistics), !Contains("error"));
  statistics.error = PictureError{0.021, 0.018, 0.0092};
  statistics.confidence = 0.95;
  statistics.stop = StopReason::error;
  CHECK_THAT(last_lines(),
             Contains("(error reached)\n") &&
                 Contains("causticl: error 2.1% or less in 95% of the pixels (noise alone 1.8%, "
                          "bias alone 0.92%), 700 photons\n"));
  const auto object = nlohmann::json::parse(statistics_json(statistics));
  CHECK(object["error"] == 0.021);
  CHECK(object["error_noise"] == 0.018);
  CHECK(object["error_bias"] == 0.0092);
  CHECK(object["confidence"] == 0.95);
  CHECK(object["stop"] == "error");
  CHECK_THAT(statistics_table(statistics), Contains("2.1% in 95% of the pixels"));
}

TEST_CASE("the table lists kernels by their fraction of the time") {
  const std::string table = statistics_table(example_statistics());
  CHECK_THAT(table, Contains("Example device") && Contains("75.0%") && Contains("25.0%"));
  CHECK(table.find("gather") < table.find("trace_photons"));
  CHECK_THAT(table, !Contains("warning"));
}

TEST_CASE("every kind of fault is counted in the table and the JSON, and warned about") {
  Statistics statistics = example_statistics();
  CHECK(diagnostic_warnings(statistics.diagnostics).empty());
  std::uint64_t count = 3;
  for (const auto& kind : diagnostic_kinds) statistics.diagnostics.*kind.count = count++;
  const std::string table = statistics_table(statistics);
  const auto object = nlohmann::json::parse(statistics_json(statistics));
  const auto warnings = diagnostic_warnings(statistics.diagnostics);
  REQUIRE(warnings.size() == std::size(diagnostic_kinds));
  for (std::size_t i = 0; i < warnings.size(); ++i) {
    const std::string number = std::to_string(i + 3);
    CHECK_THAT(table, Contains(std::string(diagnostic_kinds[i].key) + " " + number));
    CHECK(object[diagnostic_kinds[i].key] == i + 3);
    CHECK_THAT(warnings[i], StartsWith(number + " "));
  }
}

TEST_CASE("the JSON of the statistics is one object with the promised keys") {
  const auto object = nlohmann::json::parse(statistics_json(example_statistics()));
  for (const char* key :
       {"device", "seconds", "first_pass_seconds", "kernel_build_seconds", "tree_build_seconds", "passes",
        "photons", "photons_per_second", "rays", "peak_memory_bytes", "bytes_per_pixel", "kernels"})
    CHECK(object.contains(key));
  CHECK(object["passes"] == 7);
  CHECK(object["stop"] == "passes");
  CHECK(object["kernels"] == nlohmann::json{{"gather", 90.0}, {"trace_photons", 30.0}});
  CHECK(object["kernel_launches"]["gather"] == 14);
}

TEST_CASE("a device name that is not UTF-8 does no harm to the JSON") {
  Statistics statistics = example_statistics();
  statistics.device = "bad \xff name";
  CHECK(nlohmann::json::parse(statistics_json(statistics)).contains("device"));
}

TEST_CASE("devices are listed with what matters") {
  const auto devices = list_devices();
  if (devices.empty()) return;
  const std::string text = device_list(devices);
  CHECK_THAT(text, Contains("0: " + devices[0].name) && Contains(devices[0].platform_name));
  for (const char* key :
       {"type", "platform", "driver", "version", "compute units", "memory", "max allocation", "fp64"})
    CHECK_THAT(text, Contains(key));
}
