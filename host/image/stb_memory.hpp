// The memory that stb_image works in: limited, zeroed, and given back also where decoding ends by an
// exception.
#pragma once

#include <cstddef>
#include <cstdint>

namespace causticl {

/// While it lives, stb's allocations on this thread come from it.
class StbMemory {
 public:
  /// Allocations beyond `limit` bytes at one time throw std::runtime_error.
  explicit StbMemory(std::uint64_t limit);
  ~StbMemory();
  StbMemory(const StbMemory&) = delete;
  StbMemory& operator=(const StbMemory&) = delete;
};

// What stb_image calls. The memory is zeroed: stb reads tables that a damaged file did not fill.
void* stb_allocate(std::size_t size);
void* stb_reallocate(void* memory, std::size_t size);
void stb_release(void* memory);

/// Forgets the reason that stb gave last: some of its failures give none, and would repeat an earlier one's.
void stb_forget_failure();

}  // namespace causticl
