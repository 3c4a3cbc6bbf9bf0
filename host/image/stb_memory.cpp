#include "image/stb_memory.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>

namespace causticl {
namespace {

/// In front of what is given out: a ring of all blocks.
struct alignas(16) Block {
  Block *previous, *next;
  std::size_t size;
};

thread_local Block blocks{&blocks, &blocks, 0};
thread_local std::uint64_t used = 0, most = UINT64_MAX;

Block* block_of(void* memory) { return static_cast<Block*>(memory) - 1; }

}  // namespace

StbMemory::StbMemory(std::uint64_t limit) {
  most = limit;
  used = 0;
}

StbMemory::~StbMemory() {
  while (blocks.next != &blocks) stb_release(blocks.next + 1);
  most = UINT64_MAX;
}

void* stb_allocate(std::size_t size) {
  if (size > most || used > most - size)
    throw std::runtime_error("it asks for more memory than a picture of its size takes; is it damaged?");
  auto* block = static_cast<Block*>(std::calloc(1, sizeof(Block) + size));
  if (!block) throw std::bad_alloc();
  *block = {&blocks, blocks.next, size};
  blocks.next->previous = block;
  blocks.next = block;
  used += size;
  return block + 1;
}

void* stb_reallocate(void* memory, std::size_t size) {
  void* result = stb_allocate(size);
  if (memory) std::memcpy(result, memory, std::min(block_of(memory)->size, size));
  stb_release(memory);
  return result;
}

void stb_release(void* memory) {
  if (!memory) return;
  Block* block = block_of(memory);
  block->previous->next = block->next;
  block->next->previous = block->previous;
  used -= block->size;
  std::free(block);
}

}  // namespace causticl
