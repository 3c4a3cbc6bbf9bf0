#include "film/pass_set.hpp"

#include <algorithm>
#include <bit>

namespace causticl {
namespace {

/// How many of the first `passes` passes are in the first half: see passes_of_half of half_buffers.cl.
std::uint64_t of_first_half(std::uint64_t passes) {
  return passes / 2 + (passes % 2 != 0 && std::popcount(passes - 1) % 2 == 0 ? 1 : 0);
}

}  // namespace

void PassSet::add(PassRange range) {
  if (range.begin >= range.end) return;
  ranges_.push_back(range);
  std::sort(ranges_.begin(), ranges_.end(),
            [](const PassRange& a, const PassRange& b) { return a.begin < b.begin; });
  std::vector<PassRange> joined;
  for (const PassRange& next : ranges_)
    if (!joined.empty() && joined.back().end >= next.begin)
      joined.back().end = std::max(joined.back().end, next.end);
    else
      joined.push_back(next);
  ranges_ = std::move(joined);
}

bool PassSet::meets(PassRange range) const {
  return std::any_of(ranges_.begin(), ranges_.end(),
                     [&](const PassRange& own) { return own.begin < range.end && range.begin < own.end; });
}

std::uint64_t PassSet::count() const {
  std::uint64_t passes = 0;
  for (const PassRange& range : ranges_) passes += range.end - range.begin;
  return passes;
}

uint2 PassSet::halves() const {
  std::uint64_t first = 0;
  for (const PassRange& range : ranges_) first += of_first_half(range.end) - of_first_half(range.begin);
  return {static_cast<uint>(first), static_cast<uint>(count() - first)};
}

std::string text_of(PassRange range) {
  return std::to_string(range.begin + 1) + ":" + std::to_string(range.end);
}

std::string text_of(const PassSet& passes) {
  std::string text;
  for (const PassRange& range : passes.ranges()) text += (text.empty() ? "" : ", ") + text_of(range);
  return text;
}

}  // namespace causticl
