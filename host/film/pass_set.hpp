// Which passes a film holds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shared/types.h"

namespace causticl {

/// The passes from number `begin` up to `end`, counted from 0.
struct PassRange {
  std::uint64_t begin = 0, end = 0;
  bool operator==(const PassRange&) const = default;
};

/// A set of passes: ranges in order, of which no two touch.
class PassSet {
 public:
  PassSet() = default;
  PassSet(PassRange range) { add(range); }

  /// Of passes that are not in the set yet.
  void add(PassRange range);
  /// Whether any of `range` is in the set.
  bool meets(PassRange range) const;

  std::uint64_t count() const;
  /// How many there are of each half of all passes (cl/sampling/half_buffers.cl).
  uint2 halves() const;
  /// The first pass beyond all in the set.
  std::uint64_t end() const { return ranges_.empty() ? 0 : ranges_.back().end; }
  const std::vector<PassRange>& ranges() const { return ranges_; }
  /// Whether these are the first count() passes.
  bool is_whole() const { return ranges_.empty() || (ranges_.size() == 1 && ranges_[0].begin == 0); }
  bool operator==(const PassSet&) const = default;

 private:
  std::vector<PassRange> ranges_;
};

/// "1:64, 129:192": numbers that count from 1, both ends included.
std::string text_of(const PassSet& passes);
std::string text_of(PassRange range);

}  // namespace causticl
