// The one place where the code of stb's headers is compiled.
#include <stdexcept>

#include "image/stb_memory.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 65536
#define STBI_MALLOC(size) causticl::stb_allocate(size)
#define STBI_REALLOC(memory, size) causticl::stb_reallocate(memory, size)
#define STBI_FREE(memory) causticl::stb_release(memory)
// What it takes for granted, a damaged file may break.
#define STBI_ASSERT(condition) \
  if (!(condition)) throw std::runtime_error("it is damaged")
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

namespace causticl {

void stb_forget_failure() { stbi__g_failure_reason = nullptr; }

}  // namespace causticl
