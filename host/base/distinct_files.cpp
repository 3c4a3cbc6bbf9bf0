#include "base/distinct_files.hpp"

#include <filesystem>

#include "base/error.hpp"
#include "base/output_file.hpp"

namespace causticl {
namespace {

namespace fs = std::filesystem;

bool are_one(const std::string& a, const std::string& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;  // hard links as well
  const auto place = [&](const std::string& file) {
    const fs::path target = fs::absolute(link_target(file), error);
    return (fs::weakly_canonical(target.parent_path(), error) / target.filename()).lexically_normal();
  };
  return place(a) == place(b);
}

}  // namespace

void check_distinct(const std::vector<NamedFile>& files) {
  for (std::size_t i = 0; i < files.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto &one = files[j], &other = files[i];
      if (one.purpose == other.purpose || one.file.empty() || other.file.empty()) continue;
      if (is_stream(one.file) || is_stream(other.file)) continue;
      if (!are_one(one.file, other.file)) continue;
      const std::string same = one.file == other.file ? "" : ", which is " + one.file;
      throw UserError(other.file + same + ": cannot be both " + one.purpose + " and " + other.purpose +
                      "; expected two names");
    }
}

}  // namespace causticl
