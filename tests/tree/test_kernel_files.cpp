// Every file of cl/ includes what it uses, and includes depend on no condition.
#include <filesystem>

#include "catch2.hpp"

#include "base/error.hpp"
#include "device_fixture.hpp"
#include "opencl/kernel_sources.hpp"
#include "temporary_folder.hpp"

using namespace causticl;

TEST_CASE("every file of cl/ compiles by itself") {
  for (const auto& [file, text] : embedded_kernel_sources()) {
    INFO(file);
    // As if a scene called for every effect.
    std::string source = "#define EFFECTS 0xffffffffu\n" + flatten_kernel_text("#include \"" + file + "\"\n");
    if (file.ends_with("_records.h")) continue;  // types.h gives them their language
    CHECK_NOTHROW(test_device().build(source + "kernel void nothing(void) {}\n"));
    if (!file.starts_with("traversal/") && !file.starts_with("passes/")) continue;
    CHECK_NOTHROW(
        test_device().build("#define TRIANGLES_PRECOMPUTED\n" + source + "kernel void nothing(void) {}\n"));
    if (test_device().info().fp64)
      CHECK_NOTHROW(
          test_device().build("#define CAUSTICL_DOUBLE\n" + source + "kernel void nothing(void) {}\n"));
  }
}

TEST_CASE("an include under a condition is refused, and one file is included once") {
  const TemporaryFolder folder;
  folder.write("a.cl", "#if 1\n#include \"b.cl\"\n#endif\n");
  folder.write("b.cl", "#pragma once\n#if 1\nint b;\n#endif\n#include \"c.cl\"\n");
  folder.write("c.cl", "int c;\n");
  CHECK_THROWS_WITH(flatten_kernel_source("a.cl", folder.path("")),
                    Catch::Contains("a.cl:2: an include under a condition"));
  const std::string flat =
      flatten_kernel_text("#include \"b.cl\"\n#include \"c.cl\"\n#include \"b.cl\"\n", folder.path(""));
  CHECK(flat.find("int c;") == flat.rfind("int c;"));
  CHECK(flat.find("int b;") == flat.rfind("int b;"));
  CHECK(flat.find("pragma once") == flat.npos);
}

TEST_CASE("an include of a folder stands for every kernel file in it, in order") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("parts/deeper"));
  folder.write("parts/b.cl", "int b;\n");
  folder.write("parts/a.cl", "int a;\n");
  folder.write("parts/notes.txt", "not C\n");
  folder.write("parts/deeper/c.cl", "int c;\n");
  const std::string flat =
      flatten_kernel_text("#include \"parts/b.cl\"\n#include \"parts/*.cl\"\n", folder.path(""));
  CHECK(flat.find("int b;") < flat.find("int a;"));
  CHECK(flat.find("int b;") == flat.rfind("int b;"));
  CHECK(flat.find("int a;") != flat.npos);
  CHECK(flat.find("not C") == flat.npos);
  CHECK(flat.find("int c;") == flat.npos);
  CHECK(flat.find("#line 3 \"inline\"") != flat.npos);
  CHECK_THROWS_WITH(flatten_kernel_text("#include \"empty/*.cl\"\n", folder.path("")),
                    Catch::Contains("kernel sources empty/*.cl: no such files"));
  const std::string embedded = flatten_kernel_text("#include \"shapes/primitives/*.cl\"\n");
  for (const char* shape : {"sphere_intersect", "plane_intersect", "disk_intersect", "bezier_intersect"})
    CHECK(embedded.find(shape) != embedded.npos);
}
