// Values as people write them.
#include <set>

#include "catch2.hpp"

#include "base/spelling.hpp"
#include "format/option_values.hpp"
#include "scene/integrators.hpp"

using namespace causticl;

TEST_CASE("fractions are percentages or numbers below 1") {
  CHECK(parse_fraction("2%", 10) == 0.02);
  CHECK(parse_fraction("0.02", 10) == 0.02);
  CHECK(parse_fraction("200%", 10) == 2);
  CHECK(parse_fraction("1e-3", 10) == 1e-3);
  for (const char* text :
       {"2", "1", "1.0", "95", "0", "-1%", "%", "nan", "inf", "1000%", "", "2 %", "0.5x"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_fraction(text, 10));
  }
  CHECK_FALSE(parse_fraction("100%", 1));
}

TEST_CASE("a number without its percent sign is told the spellings that work") {
  CHECK(fraction_spellings("2", 10) == "2% or 0.02");
  CHECK(fraction_spellings("2.5", 10) == "2.5% or 0.025");
  CHECK(fraction_spellings("1", 10) == "1% or 0.01");
  CHECK(fraction_spellings("95", 1) == "95% or 0.95");
  CHECK(fraction_spellings("150", 10) == "150%");
  for (const char* text : {"100", "many", "0.5", "nan", "-3"}) CHECK(fraction_spellings(text, 1).empty());
  for (int percent = 1; percent < 100; ++percent) {
    const std::string text = std::to_string(percent), spellings = fraction_spellings(text, 1);
    CAPTURE(spellings);
    const std::string first = spellings.substr(0, spellings.find(' ')),
                      second = spellings.substr(spellings.rfind(' ') + 1);
    REQUIRE(parse_fraction(first, 1));
    CHECK(parse_fraction(first, 1) == parse_fraction(second, 1));
  }
}

TEST_CASE("times have units") {
  const std::pair<const char*, double> good[] = {
      {"90", 90},     {"90s", 90},     {"10m", 600},      {"1h30m", 5400},    {"1.5h", 5400},
      {"2d", 172800}, {"250ms", 0.25}, {"1H", 3600},      {"5min", 300},      {"30sec", 30},
      {"0.5", 0.5},   {"1e2", 100},    {"1h0m30s", 3630}, {"1d1h1m1s", 90061}};
  for (const auto& [text, seconds] : good) {
    CAPTURE(text);
    CHECK(parse_duration(text) == seconds);
  }
  for (const char* text :
       {"",    "0",   "0s",   "-1",     "-5m",  "m",    "10x",   "1m1h",   "1m1m", "1m1min", "10 m",
        "nan", "inf", "infs", "1h-30m", "1h30", "soon", "1e999", "1e400s", "5mm",  "+5m"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_duration(text));
  }
}

TEST_CASE("integrators have several names, in any case") {
  for (const char* text : {"pt", "PT", "path", "Path-Tracing", "path_tracer", "paths", "path tracing"})
    CHECK(parse_integrator(text) == Integrator::pt);
  for (const char* text : {"sppm", "SPPM", "photon", "photons", "photon-mapping", "Photon_Mapping", "ppm"})
    CHECK(parse_integrator(text) == Integrator::sppm);
  for (const char* text : {"", "vcm", "bdpt", "p", "sppmx", "pathh"}) CHECK_FALSE(parse_integrator(text));
  std::set<std::string> spellings;
  for (const auto& name : integrator_spellings()) {
    CHECK(parse_integrator(name));
    CHECK(spellings.insert(name).second);
  }
  for (const IntegratorRow& row : integrator_rows) CHECK(parse_integrator(row.name) == row.integrator);
}

TEST_CASE("the nearest name is suggested where one is near") {
  const std::vector<std::string> names{"--passes", "--photons", "-o", "--error"};
  CHECK(did_you_mean("--pases", names) == "; did you mean --passes?");
  CHECK(did_you_mean("--Photons", names) == "; did you mean --photons?");
  CHECK(did_you_mean("--resolution", names).empty());
  CHECK(nearest_name("", names) == nullptr);
}
