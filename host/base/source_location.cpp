#include "base/source_location.hpp"

#include "base/error.hpp"

namespace causticl {

std::string SourceLocation::text() const {
  std::string result = file;
  if (line > 0) result += ':' + std::to_string(line);
  if (!what.empty()) result.append(": ").append(what);
  return result;
}

void SourceLocation::fail(const std::string& message) const { throw UserError(text() + ": " + message); }

}  // namespace causticl
