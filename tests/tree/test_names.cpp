// Names that were given up for the field's own stay gone.
#include <sys/wait.h>

#include <cstdio>

#include "catch2.hpp"

TEST_CASE("no name that was given up is left in the sources, the documents and the help") {
  std::FILE* pipe =
      popen("bash '" CAUSTICL_SOURCE_DIR "/scripts/gone_names.sh' '" CAUSTICL_BINARY "' 2>&1", "r");
  REQUIRE(pipe);
  std::string found;
  char text[4096];
  while (const std::size_t count = std::fread(text, 1, sizeof text, pipe)) found.append(text, count);
  const int status = pclose(pipe);
  INFO(found);
  CHECK(WEXITSTATUS(status) == 0);
}
