#include "base/source_location.hpp"

#include "base/error.hpp"

namespace causticl {

std::string SourceLocation::text() const {
  return file + (line > 0 ? ":" + std::to_string(line) : "") + (what.empty() ? "" : ": " + what);
}

void SourceLocation::fail(const std::string& message) const { throw UserError(text() + ": " + message); }

}  // namespace causticl
